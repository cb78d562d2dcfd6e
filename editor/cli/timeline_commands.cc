#include "editor/cli/timeline_commands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "editor/check/drama_run.h"
#include "editor/check/timeline_edits.h"
#include "editor/cli/timeline_item_commands.h"
#include "editor/document/project.h"
#include "editor/document/timeline_fields.h"
#include "editor/export/otio.h"
#include "editor/import/motion/bml.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/sounds.h"
#include "shared/core/file.h"
#include "shared/drama/drama.h"
#include "shared/drama/sync_points.h"
#include "shared/drama/timeline_text.h"
#include "shared/stage/viseme_file.h"

namespace lararium::editor {
namespace {

using drama::LaneKind;
using exporter::TimelineBlock;

// ---- Timeline ----

// The name of an item in another program.
std::string NameOfItem(const drama::LaneSpec& lane, const Json& fields) {
  const std::string name = LabelTexts(lane, fields);
  if (name.empty() && lane.walks) {
    return fields.contains("to") ? "walk" : fields.contains("hide") ? "hide" : "place";
  }
  return lane.kind == LaneKind::kGaze ? "look at " + name : name;
}

class TimelineMaker {
 public:
  TimelineMaker(const ProjectPaths& paths,
                const ProjectDocument& document,
                const std::string& spoken,
                const DramaRun& run)
      : paths_(paths), document_(document), spoken_(spoken), run_(run) {
    for (const SoundFile& sound : FindSounds(paths)) {
      sounds_[sound.name] = paths.Shorten(sound.file);
    }
  }

  void AddItems(const drama::TimelineText& text) {
    for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
      for (size_t item = 0; item < text.lanes()[lane].size(); ++item) {
        AddItem(text, {lane, item});
      }
    }
  }

  // Adds the tasks that the script started, not an item.
  void AddTasks() {
    for (size_t i = 0; i < run_.tasks.size(); ++i) {
      const drama::TaskRecord& task = run_.tasks[i];
      if (task.from_timeline) {
        continue;
      }
      TimelineBlock block;
      block.name = task.action + (task.object.empty() ? "" : " " + task.object);
      block.begin = task.began;
      block.end = task.ended;
      block.metadata = {{"from", "script"},      {"actor", task.actor}, {"action", task.action},
                        {"object", task.object}, {"where", task.where}, {"failed", task.failed}};
      if (task.action.starts_with("say ")) {
        AddVoice(task.action.substr(4), block);
      }
      Track(drama::LaneOfTask(task.action), task.actor).push_back(std::move(block));
    }
  }

  // Takes tracks in the order of the cast and of lanes, then those of the stage.
  exporter::ShowTimeline Take() {
    exporter::ShowTimeline timeline;
    timeline.title = document_.title;
    std::vector<std::string> owners;
    for (const CastDocument& member : document_.cast) {
      owners.push_back(member.name);
    }
    owners.emplace_back();
    for (const std::string& owner : owners) {
      for (const drama::LaneSpec& lane : drama::LaneSpecs()) {
        const auto found = tracks_.find({owner, lane.kind});
        if (found == tracks_.end()) {
          continue;
        }
        if (lane.kind == LaneKind::kMarkers) {
          timeline.markers = std::move(found->second);
          continue;
        }
        timeline.tracks.push_back({(owner.empty() ? "" : owner + " ") + std::string(lane.name),
                                   lane.audible, std::move(found->second)});
      }
    }
    return timeline;
  }

 private:
  std::vector<TimelineBlock>& Track(LaneKind kind, const std::string& actor) {
    return tracks_[{drama::IsOfActor(kind) ? actor : "", kind}];
  }

  void AddVoice(const std::string& line, TimelineBlock& block) const {
    if (const StageWords::Line* known = run_.words.FindLine(line)) {
      block.media = paths_.Shorten(paths_.Speech(spoken_, line + ".flac"));
      block.media_seconds = known->seconds;
    }
  }

  // The end of an item in the run, or after the duration of what it names.
  double EndOf(const drama::TimelineText& text, drama::TimelineItem item) const {
    const drama::TimelineLane& lane = text.lanes()[item.lane];
    const double at = lane.at[item.item];
    for (const drama::TaskRecord& task : run_.tasks) {
      if (task.from_timeline && task.actor == lane.actor &&
          drama::LaneOfTask(task.action) == lane.kind &&
          std::abs(task.began - at) < 1.0 / drama::Drama::kTicksPerSecond) {
        return std::max(task.ended, at + lane.length[item.item]);
      }
    }
    return at + (lane.length[item.item] > 0.0 ? lane.length[item.item]
                                              : NaturalSeconds(text, item, run_));
  }

  void AddItem(const drama::TimelineText& text, drama::TimelineItem item) {
    const drama::TimelineLane& lane = text.lanes()[item.lane];
    Json fields = Json::object();
    for (const drama::TimelineField& field : text.Fields(item)) {
      fields[field.key] = field.value;
    }
    const drama::LaneSpec& spec = drama::SpecOf(lane.kind);
    TimelineBlock block;
    block.name = NameOfItem(spec, fields);
    block.begin = lane.at[item.item];
    block.end = EndOf(text, item);
    block.metadata = {
        {"from", "timeline"},
        {"lane", spec.name},
        {"actor", lane.actor},
        {"where", paths_.Drama().filename().string() + ":" + std::to_string(text.LineOf(item))},
        {"item", fields}};
    const std::string content = TextOf(fields, spec.content);
    if (spec.line == drama::LineUse::kSpoken) {
      AddVoice(content, block);
    } else if (spec.audible) {
      const auto found = sounds_.find(content);
      block.media = found == sounds_.end() ? "" : found->second;
    }
    Track(lane.kind, lane.actor).push_back(std::move(block));
  }

  const ProjectPaths& paths_;
  const ProjectDocument& document_;
  const std::string& spoken_;
  const DramaRun& run_;
  std::map<std::string, std::string, std::less<>> sounds_;
  std::map<std::pair<std::string, LaneKind>, std::vector<TimelineBlock>> tracks_;
};

// ---- Behaviours ----

Status ReadActorNames(const ImportBmlOptions& options,
                      const ProjectDocument& document,
                      import::BmlStage& world) {
  for (const CastDocument& member : document.cast) {
    world.characters[member.name] = member.name;
  }
  for (const std::string& pair : options.actors) {
    const size_t equals = pair.find('=');
    const std::string name = equals == std::string::npos ? "" : pair.substr(equals + 1);
    const bool known = std::any_of(document.cast.begin(), document.cast.end(),
                                   [&](const CastDocument& member) { return member.name == name; });
    if (!known) {
      return Status::Error("--actor " + pair, "does not name a person of the cast",
                           "write ID=NAME, as in the file and as in the project");
    }
    world.characters[pair.substr(0, equals)] = name;
  }
  if (document.cast.size() == 1) {
    world.characters[""] = document.cast.front().name;
  }
  return Status();
}

// What behaviours can refer to, and its timing.
Result<import::BmlStage> StageForBml(const ImportBmlOptions& options,
                                     const ProjectPaths& paths,
                                     const ProjectDocument& document) {
  import::BmlStage world;
  LARARIUM_RETURN_IF_ERROR(ReadActorNames(options, document, world));
  for (const CastDocument& member : document.cast) {
    LARARIUM_ASSIGN_OR_RETURN(const human::Human human, LoadBakedHuman(paths, member));
    for (const human::Clip& clip : human.clips) {
      constexpr double kFade = 0.3;  // The default fade of gestures.
      world.clips[member.name][clip.name] =
          drama::GestureTimes(clip, human::TurnedFromFirst(clip, human.skeleton.size()), kFade);
    }
  }
  for (const ObjectDocument& object : document.objects) {
    world.objects[object.name] = {object.position.x(), object.position.z()};
  }
  LARARIUM_ASSIGN_OR_RETURN(const ProjectLines lines, LoadProjectLines(paths, document));
  LARARIUM_ASSIGN_OR_RETURN(const auto spoken, SpokenLines(paths, document, lines));
  for (const SpokenLine& line : spoken) {
    if (line.language != lines.spoken.front()) {
      continue;
    }
    import::BmlLine& known = world.lines[line.line->id];
    for (const auto& [language, text] : line.line->text) {
      known.texts.push_back(text);
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::string visemes, ReadText(line.visemes));
    LARARIUM_ASSIGN_OR_RETURN(const human::VisemeTrack track,
                              stage::ParseVisemes(visemes, line.visemes.string()));
    known.times = drama::SpeechTimes(track);
  }
  return world;
}

Status InsertItem(const import::BmlItem& item, drama::TimelineText& text) {
  const auto find = [&]() -> std::optional<size_t> {
    for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
      if (text.lanes()[lane].kind == item.lane && text.lanes()[lane].actor == item.actor) {
        return lane;
      }
    }
    return std::nullopt;
  };
  std::optional<size_t> lane = find();
  if (!lane) {
    LARARIUM_RETURN_IF_ERROR(text.AddLane(item.lane, item.actor).status());
    lane = find();
    CHECK(lane.has_value());
  }
  return text.Insert(*lane, item.fields).status();
}

}  // namespace

Result<CommandResult> RunTimeline(const TimelineOptions& options, Progress& progress) {
  if (options.out.empty()) {
    return EditTimeline(options, progress);
  }
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const ProjectLines lines, LoadProjectLines(paths, document));
  LARARIUM_ASSIGN_OR_RETURN(
      const std::string spoken,
      show::ChooseLanguage(lines.spoken, options.spoken, "speech", paths.Project().string()));
  LARARIUM_ASSIGN_OR_RETURN(const std::string script, ReadText(paths.Drama()));
  LARARIUM_ASSIGN_OR_RETURN(const drama::TimelineText text,
                            drama::TimelineText::Read(script, paths.Drama().filename().string()));
  LARARIUM_ASSIGN_OR_RETURN(const DramaRun run,
                            RunDrama(paths, document, spoken, script, options.seconds, progress));
  TimelineMaker maker(paths, document, spoken, run);
  maker.AddItems(text);
  maker.AddTasks();
  const Json otio = exporter::FormatOtio(maker.Take());
  LARARIUM_RETURN_IF_ERROR(SaveJson(options.out, otio));
  const size_t tracks = otio["tracks"]["children"].size();
  return CommandResult{options.out.string() + ": " + std::to_string(tracks) + " tracks\n",
                       {{"out", options.out.string()}, {"tracks", tracks}}};
}

Result<CommandResult> RunImportBml(const ImportBmlOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const import::BmlStage world, StageForBml(options, paths, document));
  LARARIUM_ASSIGN_OR_RETURN(const std::string bml, ReadText(options.file, import::kMaxBmlBytes));
  LARARIUM_ASSIGN_OR_RETURN(const import::BmlImport imported,
                            import::ImportBml(bml, options.file.string(), world, options.begin));
  LARARIUM_ASSIGN_OR_RETURN(std::string script, ReadText(paths.Drama()));
  LARARIUM_ASSIGN_OR_RETURN(
      drama::TimelineText text,
      drama::TimelineText::Read(std::move(script), paths.Drama().filename().string()));
  for (const import::BmlItem& item : imported.items) {
    LARARIUM_RETURN_IF_ERROR(InsertItem(item, text));
  }
  if (!imported.items.empty()) {
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(paths.Drama(), text.text()));
  }
  CommandResult result;
  for (const std::string& warning : imported.warnings) {
    result.text += "warning: " + warning + "\n";
  }
  result.text += std::to_string(imported.items.size()) + " items\n";
  result.json = {{"items", imported.items.size()}, {"warnings", imported.warnings}};
  return result;
}

}  // namespace lararium::editor
