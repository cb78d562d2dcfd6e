#include "editor/check/drama_run.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

#include "editor/jobs/sounds.h"
#include "editor/jobs/stage_setup.h"
#include "shared/audio/sound_file.h"
#include "shared/stage/stage.h"

namespace lararium::editor {
namespace {

// The largest magnitude in each hundredth of a second. Empty if the sound cannot be decoded,
// which baking reports.
std::vector<uint8_t> PeaksOf(const show::Speech& speech) {
  std::vector<uint8_t> peaks;
  if (speech.sound.empty()) {
    return peaks;
  }
  Result<audio::SoundReader> reader = audio::SoundReader::Open(speech.sound, speech.name);
  if (!reader.ok()) {
    return peaks;
  }
  const auto frames = static_cast<size_t>(
      std::max(std::lround(reader->rate() / StageWords::Line::kPeaksPerSecond), 1L));
  std::vector<int16_t> samples(frames * static_cast<size_t>(reader->channels()));
  while (const size_t read = reader->Read(samples)) {
    int peak = 0;
    for (size_t i = 0; i < read * static_cast<size_t>(reader->channels()); ++i) {
      peak = std::max(peak, std::abs(static_cast<int>(samples[i])));
    }
    peaks.push_back(static_cast<uint8_t>(std::min(peak / 128, 255)));
  }
  return peaks;
}

StageWords WordsOf(const ProjectPaths& paths,
                   const stage::Stage& stage,
                   const show::ShowContent& content) {
  StageWords words;
  for (const stage::ActorId id : stage.actors()) {
    const stage::Actor& actor = *stage.Find(id);
    StageWords::Person person{actor.name, {}};
    for (const human::Clip& clip : actor.human().clips) {
      person.clips.push_back({clip.name, clip.duration});
    }
    words.people.push_back(std::move(person));
  }
  for (const stage::ObjectId id : stage.objects()) {
    const stage::Object& object = *stage.Find(id);
    StageWords::Thing thing{object.name, {}, {}, !object.use().lights.empty()};
    for (const stage::ObjectAction& action : object.use().actions) {
      thing.actions.push_back(action.name);
    }
    for (const stage::Surface& surface : object.use().surfaces) {
      thing.surfaces.push_back(surface.name);
    }
    words.things.push_back(std::move(thing));
  }
  for (const show::Speech& speech : content.speech) {
    const std::optional<int> index = stage.FindSpeech(speech.name);
    words.lines.push_back({speech.name, index ? stage.SpeechSeconds(*index) : 0.0, PeaksOf(speech),
                           speech.visemes.keys});
  }
  for (const SoundFile& sound : FindSounds(paths)) {
    words.sounds.push_back(sound.name);
  }
  return words;
}

std::shared_ptr<const stage::Navigation> FloorOf(const stage::Stage& stage) {
  const stage::Stage::Checkpoint now = stage.Save();
  for (size_t gate = 0; now.navigation != nullptr && gate < now.gates.size(); ++gate) {
    now.navigation->OpenGate(gate, true);
  }
  return now.navigation;
}

template <typename Named>
const Named* FindNamed(const std::vector<Named>& list, std::string_view name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const Named& n) { return n.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

const StageWords::Person* StageWords::FindPerson(std::string_view name) const {
  return FindNamed(people, name);
}

const StageWords::Thing* StageWords::FindThing(std::string_view name) const {
  return FindNamed(things, name);
}

double StageWords::ClipSeconds(std::string_view person, std::string_view clip) const {
  const Person* found = FindPerson(person);
  const Timed* timed = found != nullptr ? FindNamed(found->clips, clip) : nullptr;
  return timed != nullptr ? timed->seconds : 0.0;
}

const StageWords::Line* StageWords::FindLine(std::string_view line) const {
  return FindNamed(lines, line);
}

Result<std::unique_ptr<StagedDrama>> StageDrama(const ProjectPaths& paths,
                                                const ProjectDocument& document,
                                                const std::string& spoken,
                                                const std::string& script) {
  auto staged = std::make_unique<StagedDrama>();
  LARARIUM_RETURN_IF_ERROR(FillStage(paths, document, spoken, staged->stage, staged->content));
  staged->log = MakeSilentLog();
  LARARIUM_ASSIGN_OR_RETURN(
      staged->drama, drama::Drama::Create(script, paths.Drama().filename().string(), staged->stage,
                                          {}, *staged->log));
  return staged;
}

Status PlayDry(drama::Drama& drama,
               double seconds,
               Progress& progress,
               const std::function<void()>& after_tick) {
  const auto ticks = static_cast<int64_t>(seconds * drama::Drama::kTicksPerSecond);
  for (int64_t tick = 0; tick < ticks; ++tick) {
    drama.Tick();
    after_tick();
    progress.Report("running the drama",
                    static_cast<double>(tick + 1) / static_cast<double>(ticks));
    if (progress.Cancelled()) {
      return Status::Error("the dry run", "was cancelled");
    }
  }
  return Status();
}

Result<DramaRun> RunDrama(const ProjectPaths& paths,
                          const ProjectDocument& document,
                          const std::string& spoken,
                          const std::string& script,
                          double seconds,
                          Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const auto staged, StageDrama(paths, document, spoken, script));
  const drama::Drama& drama = *staged->drama;
  TrailRecorder trails(staged->stage);
  trails.Note(drama.time());
  LARARIUM_RETURN_IF_ERROR(
      PlayDry(*staged->drama, seconds, progress, [&] { trails.Note(drama.time()); }));
  DramaRun run;
  run.trails = trails.Take();
  run.floor = FloorOf(staged->stage);
  run.words = WordsOf(paths, staged->stage, staged->content);
  run.seconds = drama.time();
  run.tasks.assign(drama.tasks().begin(), drama.tasks().end());
  std::stable_sort(run.tasks.begin(), run.tasks.end(),
                   [](const auto& a, const auto& b) { return a.began < b.began; });
  for (const drama::TaskRecord& task : run.tasks) {
    run.last = std::max(run.last, task.ended);
  }
  std::set<std::string> told;
  for (const drama::ScriptError& error : drama.errors()) {
    if (told.insert(error.message).second) {
      run.problems.push_back(error.message);
    }
  }
  return run;
}

}  // namespace lararium::editor
