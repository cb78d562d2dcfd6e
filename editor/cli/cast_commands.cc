#include "editor/cli/cast_commands.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "editor/bake/line_table.h"
#include "editor/cli/command_arguments.h"
#include "editor/document/cast_edits.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/bone_review.h"
#include "editor/jobs/thumbnail.h"
#include "editor/jobs/voice_sample.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

// Changes the source of the figure and the given properties; keeps the others.
Status ChangeFigure(const CastOptions& options, const ProjectPaths& paths, CastDocument& member) {
  const bool other =
      options.plain || !options.preset.empty() || !options.recipe.empty() || !options.model.empty();
  if (other) {
    member.preset = options.preset;
    member.recipe.reset();
    member.model = options.model.empty() ? "" : paths.Shorten(options.model);
  }
  if (!options.recipe.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(member.recipe, import::LoadCastRecipe(options.recipe));
  }
  if (!options.bone_map.empty()) {
    member.bone_map = paths.Shorten(options.bone_map);
  }
  member.height = options.height.value_or(member.height);
  if (!options.tunic.empty()) {
    member.tunic = {options.tunic[0], options.tunic[1], options.tunic[2]};
  }
  return Status();
}

// "JOINT=BONE" sets a bone, "JOINT=" means none, "JOINT" restores the automatic choice.
void ChangeBones(const std::vector<std::string>& bones, CastDocument& member) {
  for (const std::string& text : bones) {
    const size_t equals = text.find('=');
    ChooseBone(text.substr(0, equals),
               equals == std::string::npos ? std::nullopt : std::optional(text.substr(equals + 1)),
               member);
  }
}

Status ChangeVoice(const CastOptions& options, CastDocument& member) {
  bake::VoiceSettings& voice = member.voice;
  voice.variant = options.voice_variant.value_or(voice.variant);
  voice.pitch = options.voice_pitch.value_or(voice.pitch);
  voice.range = options.voice_range.value_or(voice.range);
  voice.rate = options.voice_rate.value_or(voice.rate);
  return voice.Validate("voice of " + member.name);
}

Status AddClip(const CastOptions& options, const ProjectPaths& paths, CastDocument& member) {
  ClipDocument clip;
  clip.name = options.clip_name.empty() ? options.add_clip.stem().string() : options.clip_name;
  clip.file = paths.Shorten(options.add_clip);
  clip.loops = options.loops;
  LARARIUM_RETURN_IF_ERROR(CheckPlainName("--clip-name", clip.name));
  return editor::AddClip(std::move(clip), member);
}

Status Change(const CastOptions& options, const ProjectPaths& paths, CastDocument& member) {
  if (options.title) {
    LARARIUM_RETURN_IF_ERROR(CheckTitle("--title", *options.title));
    SetTitle(*options.title, member);
  }
  LARARIUM_RETURN_IF_ERROR(ChangeFigure(options, paths, member));
  ChangeBones(options.bones, member);
  LARARIUM_RETURN_IF_ERROR(ChangeVoice(options, member));
  if (!options.remove_clip.empty()) {
    LARARIUM_RETURN_IF_ERROR(RemoveClip(options.remove_clip, member));
  }
  if (!options.rename_clip.empty()) {
    LARARIUM_RETURN_IF_ERROR(RenameClip(options.rename_clip, options.to, member));
  }
  return options.add_clip.empty() ? Status() : AddClip(options, paths, member);
}

std::string FigureText(const CastDocument& member) {
  if (!member.preset.empty()) {
    return "preset " + member.preset;
  }
  if (member.recipe) {
    return "recipe of this project";
  }
  return member.model.empty() ? "plain figure" : "model " + member.model;
}

CommandResult List(const ProjectDocument& document) {
  CommandResult result;
  result.json = Json::array();
  for (const CastDocument& member : document.cast) {
    const std::string title = member.title.empty() ? "" : " (" + member.title + ")";
    result.text += member.name + title + ": " + FigureText(member);
    for (const ClipDocument& clip : member.clips) {
      result.text += "; " + clip.name + " from " + clip.file;
    }
    result.text += "\n";
    result.json.push_back(FormatFields(member));
  }
  if (document.cast.empty()) {
    result.text = "the cast is empty; add a person with --name NAME\n";
  }
  return result;
}

// Builds the figure, so that errors in its file or clips are reported now, and lists its clips.
Result<CommandResult> Build(const ProjectPaths& paths, const CastDocument& member) {
  LARARIUM_ASSIGN_OR_RETURN(const BakedHuman baked, BakeHuman(paths, member));
  CommandResult result;
  for (const std::string& warning : baked.warnings) {
    result.text += "warning: " + warning + "\n";
  }
  if (const Status drawn = LeaveThumbnail(paths.Human(member.name), baked.human); !drawn.ok()) {
    // Happens on machines without OpenGL.
    result.text += "no thumbnail: " + drawn.message() + "\n";
  }
  Json clips = Json::array();
  result.text += member.name + ": clips";
  for (const human::Clip& clip : baked.human.clips) {
    clips.push_back(clip.name);
    result.text += " " + clip.name;
  }
  result.text += "\n";
  result.json = {{"name", member.name}, {"clips", clips}, {"warnings", baked.warnings}};
  return result;
}

// Warns where the drama still uses a motion that was removed. An unreadable script is not an
// error of this command.
void WarnOfUses(const ProjectPaths& paths, const std::string& clip, CommandResult& result) {
  const Result<std::string> script = ReadText(paths.Drama());
  if (clip.empty() || !script.ok()) {
    return;
  }
  for (const size_t line : LinesThatSay(*script, clip)) {
    result.text +=
        paths.Drama().string() + ":" + std::to_string(line) + ": says \"" + clip + "\" still\n";
    result.json["still_said"].push_back({{"clip", clip}, {"line", line}});
  }
}

Status WriteSample(const ProjectPaths& paths,
                   const ProjectDocument& document,
                   const CastDocument& member,
                   const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::LinesFile lines, bake::ReadLines(paths.folder));
  LARARIUM_ASSIGN_OR_RETURN(
      const std::vector<std::byte> sound,
      SpeakSample(SampleOf(lines.table, document.speech, member), member.voice));
  return WriteFileAtomically(file, sound);
}

class CastWorker {
 public:
  CastWorker(ProjectPaths paths, ProjectDocument document, const CastOptions& options)
      : paths_(std::move(paths)), document_(std::move(document)), options_(options) {}

  Result<CommandResult> Run() {
    if (!options_.remove.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(const CastDocument* member, Known(options_.remove));
      document_.cast.erase(document_.cast.begin() + (member - document_.cast.data()));
      LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, document_));
    }
    return options_.name.empty() ? List(document_) : AddOrChange();
  }

 private:
  Result<CommandResult> AddOrChange() {
    LARARIUM_ASSIGN_OR_RETURN(CastDocument * member, Wanted());
    LARARIUM_RETURN_IF_ERROR(Change(options_, paths_, *member));
    LARARIUM_ASSIGN_OR_RETURN(CommandResult result, Build(paths_, *member));
    LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, document_));
    WarnOfUses(paths_, options_.remove_clip, result);
    WarnOfUses(paths_, options_.rename_clip, result);
    if (!options_.listen.empty()) {
      LARARIUM_RETURN_IF_ERROR(WriteSample(paths_, document_, *member, options_.listen));
      result.text += "wrote " + options_.listen.string() + "\n";
      result.json["voice"] = options_.listen.string();
    }
    return result;
  }

  Result<CastDocument*> Known(const std::string& name) {
    return FindTitled(document_.cast, name, paths_.Project().string(), "has no person");
  }

  // Finds the member with this name. Creates one unless the options require an existing member.
  Result<CastDocument*> Wanted() {
    const Result<CastDocument*> known = Known(options_.name);
    if (known.ok() || !options_.add_clip.empty() || !options_.remove_clip.empty() ||
        !options_.rename_clip.empty()) {
      return known;
    }
    CastDocument added;
    LARARIUM_RETURN_IF_ERROR(NameEntry(document_.cast, "--name", options_.name, "person", added));
    document_.cast.push_back(std::move(added));
    return &document_.cast.back();
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  const CastOptions& options_;
};

}  // namespace

Result<CommandResult> RunCast(const CastOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  return CastWorker(paths, std::move(document), options).Run();
}

}  // namespace lararium::editor
