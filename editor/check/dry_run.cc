#include "editor/check/dry_run.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "editor/check/drama_checks.h"
#include "editor/check/line_checks.h"
#include "editor/document/check_sentences.h"
#include "editor/jobs/stage_setup.h"
#include "editor/jobs/staging.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/core/statistics.h"
#include "shared/drama/drama.h"
#include "shared/drama/timeline_text.h"
#include "shared/stage/stage.h"

namespace lararium::editor {
namespace {

constexpr int kTicksPerFrame = 4;  // Frames are 1/30 s.

// Reports the tasks that failed, except those that may fail according to the drama, then errors
// that are not the end of such a task. `tasks` are those of the drama, in the same order, with
// locations.
std::vector<Sentence> DramaProblems(const drama::Drama& drama,
                                    std::span<const drama::TaskRecord> tasks) {
  std::vector<Sentence> problems;
  std::vector<const drama::TaskRecord*> failed;
  for (size_t i = 0; i < tasks.size(); ++i) {
    const drama::TaskRecord& task = tasks[i];
    if (task.failed && !task.expected) {
      failed.push_back(&drama.tasks()[i]);
      const std::string what = task.actor + ": " + task.action +
                               (task.object.empty() ? "" : " " + task.object) + ": " + task.message;
      problems.push_back(AtTime(AtPlace(task.where, what), task.ended));
    }
  }
  for (const drama::ScriptError& error : drama.errors()) {
    const bool is_told = std::any_of(failed.begin(), failed.end(), [&](const auto* task) {
      return task->ended == error.time && error.message.starts_with(task->where) &&
             error.message.ends_with(task->message);
    });
    if (!is_told) {
      problems.push_back(AtTime(error.message, error.time));
    }
  }
  return problems;
}

Json TasksJson(std::span<const drama::TaskRecord> tasks) {
  Json json = Json::array();
  for (const drama::TaskRecord& task : tasks) {
    json.push_back({{"began", task.began},
                    {"ended", task.ended},
                    {"where", task.where},
                    {"actor", task.actor},
                    {"action", task.action},
                    {"object", task.object},
                    {"failed", task.failed},
                    {"expected", task.expected},
                    {"from_timeline", task.from_timeline},
                    {"waited", task.waited},
                    {"message", task.message}});
  }
  return json;
}

// A visitor of a dry run; without a log there is no visitor.
struct Guest {
  std::string name;
  std::optional<drama::VisitorLog> log;
};

// First no visitor, then the visitors of the project by name, then those of the options.
std::vector<Guest> GuestsOf(const ProjectPaths& paths,
                            const CheckOptions& options,
                            std::vector<Sentence>& problems) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry :
       std::filesystem::directory_iterator(paths.folder / "visitors", ignored)) {
    if (entry.path().extension() == ".visitor") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  files.insert(files.end(), options.visitors.begin(), options.visitors.end());
  std::vector<Guest> guests(1);
  for (const std::filesystem::path& file : files) {
    Result<drama::VisitorLog> log = drama::VisitorLog::Load(file);
    if (log.ok()) {
      guests.push_back({file.stem().string(), *std::move(log)});
    } else {
      problems.push_back(log.message());
    }
  }
  return guests;
}

struct Seen {
  DryRunReport report;
  std::vector<SaidLine> said;
  CuesSeen cues;
  bool ran = false;
};

// Checks that seeking to a time gives the same stage as playing to it.
class SeekCheck {
 public:
  SeekCheck(int count, int64_t ticks) {
    Random random(1);
    for (int i = 0; i < count && ticks > 0; ++i) {
      wanted_.push_back(random.Below(static_cast<uint32_t>(std::min<int64_t>(ticks, 1 << 30))));
    }
  }

  // Records the stage at the chosen ticks while the drama plays.
  void See(int64_t tick, const stage::Stage& stage) {
    if (std::find(wanted_.begin(), wanted_.end(), tick) != wanted_.end()) {
      stage.Capture(seen_[tick]);
    }
  }

  // Seeks to each tick in the order in which they were drawn.
  void Run(drama::Drama& drama, const stage::Stage& stage, DryRunReport& report) {
    StageTimes times;
    stage::StageSnapshot now;
    int differ = 0;
    for (const int64_t tick : wanted_) {
      const double time = static_cast<double>(tick) / drama::Drama::kTicksPerSecond;
      const Status status = [&] {
        const ScopedStageTimer timer(times);
        return drama.Seek(time);
      }();
      stage.Capture(now);
      if (!status.ok() || now != seen_[tick]) {
        ++differ;
        report.problems.push_back(
            AtTime(Sentence("seeking gives another stage than playing"), time));
      }
    }
    report.seeks = {{"differ", differ}, {"milliseconds", times.ToJson()}};
  }

 private:
  std::vector<int64_t> wanted_;
  std::map<int64_t, stage::StageSnapshot> seen_;
};

class DryRunner {
 public:
  DryRunner(const ProjectPaths& paths,
            const ProjectDocument& document,
            const ProjectLines& lines,
            const CheckOptions& options,
            Progress& progress)
      : paths_(paths),
        document_(document),
        lines_(lines),
        options_(options),
        progress_(progress),
        file_(paths.Drama().filename().string()) {}

  DryRunReport RunAll() {
    DryRunReport all;
    const Result<std::string> script = ReadText(paths_.Drama());
    if (!script.ok()) {
      return {.problems = {script.message()}};
    }
    script_ = *script;
    if (const std::optional<Sentence> problem = CheckEncoding(script_, file_)) {
      return {.problems = {*problem}};
    }
    const Result<drama::TimelineText> timeline = drama::TimelineText::Read(script_, file_);
    if (timeline.ok()) {
      Append({timeline->problems().begin(), timeline->problems().end()}, all.problems);
    }
    if (const Status status = LoadPlaces(); !status.ok()) {
      return {.problems = {status.message()}};
    }
    const std::vector<Guest> guests = GuestsOf(paths_, options_, all.problems);
    std::vector<std::string> languages = lines_.spoken;
    languages.resize(std::max<size_t>(languages.size(), 1));
    runs_ = languages.size() * guests.size();
    CuesSeen cues;
    bool ran = true;
    for (const std::string& language : languages) {
      for (const Guest& guest : guests) {
        Seen seen = Run(language, guest, done_ == 0 ? options_.seeks : 0);
        ran = ran && seen.ran;
        Add(seen, language, guest, all, cues);
        ++done_;
      }
    }
    cues.seconds = options_.seconds;
    if (ran && !progress_.Cancelled() && options_.seconds > 0.0) {
      Append(CheckCues(script_, file_, cues), all.problems);
      if (all.tasks.empty() && cues.cues.empty() && timeline.ok() && timeline->lanes().empty() &&
          !Names(script_, "main")) {
        all.problems.push_back(AtPlace(
            file_ + ":1", Sentence("has no function main() and no track, so nothing happens")));
      }
    }
    return all;
  }

 private:
  // Loads the obstacles of all places.
  Status LoadPlaces() {
    for (const PlaceDocument& place : document_.places) {
      LARARIUM_ASSIGN_OR_RETURN(stage::Place staged, StageObstacles(paths_, place));
      places_.push_back(std::move(staged));
    }
    return Status();
  }

  Seen Run(const std::string& language, const Guest& guest, int seek_count) {
    Seen seen;
    stage::Stage stage;
    show::ShowContent content;
    if (const Status filled = FillStage(paths_, document_, language, stage, content);
        !filled.ok()) {
      seen.report.problems = {
          filled.message(),
          AtPlace(paths_.Drama().string(), Sentence("was not run: the stage is not complete"))};
      return seen;
    }
    const std::shared_ptr<Log> silent = MakeSilentLog();
    const auto drama = drama::Drama::Create(script_, file_, stage, {}, *silent);
    if (!drama.ok()) {
      seen.report.problems = {drama.message()};
      return seen;
    }
    if (guest.log) {
      (*drama)->SetVisitorLog(*guest.log);
    }
    LineListener lines(stage, content);
    DescriptionListener descriptions(stage, content,
                                     LongestDescriptions(paths_, document_, lines_));
    StepListener steps(stage, places_);
    GroundListener ground(stage, places_);
    SeekCheck seeks(seek_count, Ticks());
    seeks.See(0, stage);
    steps.Listen(0.0);
    ground.Listen(0.0);
    StageTimes frames;
    for (int64_t tick = 0; tick < Ticks() && !progress_.Cancelled();) {
      double cpu = 0.0;
      for (const int64_t end = std::min(tick + kTicksPerFrame, Ticks()); tick < end;) {
        const double begin = ThreadCpuMilliseconds();
        (*drama)->Tick();
        cpu += ThreadCpuMilliseconds() - begin;
        ++tick;
        lines.Listen((*drama)->time());
        descriptions.Listen((*drama)->time());
        steps.Listen((*drama)->time());
        ground.Listen((*drama)->time());
        seeks.See(tick, stage);
        for (const stage::StageCaption& caption : stage.captions()) {
          seen.cues.lines.insert(content.speech[static_cast<size_t>(caption.line)].name);
        }
      }
      frames.Add(cpu, cpu);
      progress_.Report("running the drama",
                       (static_cast<double>(done_) + static_cast<double>(tick) / Ticks()) /
                           static_cast<double>(runs_));
    }
    seen.ran = true;
    seen.said = lines.said();
    seen.cues.lines.insert(descriptions.described().begin(), descriptions.described().end());
    seen.cues.cues.assign((*drama)->cues().begin(), (*drama)->cues().end());
    Judge(**drama, steps, ground, seen);
    for (const Sentence& problem : descriptions.problems()) {
      seen.report.problems.push_back(AtPlace(file_, problem));
    }
    seen.report.runs.push_back({{"language", language},
                                {"visitor", guest.name},
                                {"tasks", seen.report.tasks.size()},
                                {"lines", seen.said.size()},
                                {"frame_milliseconds", frames.ToJson()}});
    if (!progress_.Cancelled()) {
      seeks.Run(**drama, stage, seen.report);
    }
    return seen;
  }

  void Judge(const drama::Drama& drama,
             const StepListener& steps,
             const GroundListener& ground,
             Seen& seen) const {
    std::vector<drama::TaskRecord> tasks(drama.tasks().begin(), drama.tasks().end());
    PlaceItems(script_, file_, tasks);
    std::vector<Sentence>& problems = seen.report.problems;
    problems = DramaProblems(drama, tasks);
    Append(CheckTogether(tasks), problems);
    Append(CheckTurns(tasks), problems);
    Append(steps.Problems(script_, file_, tasks), problems);
    Append(ground.Problems(), problems);
    Append(CheckOccluders(places_), problems);
    Append(CheckSaid(paths_, lines_, seen.said, tasks), problems);
    seen.report.tasks = TasksJson(tasks);
  }

  // Reports a problem of several runs for the first one only; the others may differ just in
  // time.
  void Add(Seen& seen,
           const std::string& language,
           const Guest& guest,
           DryRunReport& all,
           CuesSeen& cues) {
    for (const Sentence& problem : seen.report.problems) {
      const std::string english = problem.English();
      if (told_.insert(english.substr(0, english.rfind(" (at "))).second) {
        all.problems.push_back(done_ == 0 ? problem : OfRun(problem, language, guest.name));
      }
    }
    if (done_ == 0) {
      all.tasks = std::move(seen.report.tasks);
      all.seeks = std::move(seen.report.seeks);
    }
    all.runs.insert(all.runs.end(), seen.report.runs.begin(), seen.report.runs.end());
    cues.visited = cues.visited || guest.log.has_value();
    cues.lines.merge(seen.cues.lines);
    for (const SaidLine& said : seen.said) {
      cues.lines.insert(said.line);
    }
    for (const drama::CueRecord& cue : seen.cues.cues) {
      const auto known = std::find_if(cues.cues.begin(), cues.cues.end(), [&](const auto& other) {
        return other.where == cue.where && other.kind == cue.kind && other.name == cue.name;
      });
      if (known == cues.cues.end()) {
        cues.cues.push_back(cue);
      } else {
        known->fired = known->fired || cue.fired;
      }
    }
  }

  // Adds what distinguishes the run from others.
  Sentence OfRun(const Sentence& problem,
                 const std::string& language,
                 const std::string& visitor) const {
    const bool tells_language = lines_.spoken.size() > 1;
    if (tells_language && !visitor.empty()) {
      return Sentence("%s [in '%s', visitor '%s']", {problem, language, visitor});
    }
    if (tells_language) {
      return Sentence("%s [in '%s']", {problem, language});
    }
    return visitor.empty() ? problem : Sentence("%s [visitor '%s']", {problem, visitor});
  }

  int64_t Ticks() const {
    return static_cast<int64_t>(options_.seconds * drama::Drama::kTicksPerSecond);
  }

  const ProjectPaths& paths_;
  const ProjectDocument& document_;
  const ProjectLines& lines_;
  const CheckOptions& options_;
  Progress& progress_;
  std::string file_;
  std::string script_;
  std::vector<stage::Place> places_;
  std::set<std::string> told_;
  size_t runs_ = 1;
  size_t done_ = 0;
};

}  // namespace

DryRunReport DryRunAll(const ProjectPaths& paths,
                       const ProjectDocument& document,
                       const ProjectLines& lines,
                       const CheckOptions& options,
                       Progress& progress) {
  return DryRunner(paths, document, lines, options, progress).RunAll();
}

}  // namespace lararium::editor
