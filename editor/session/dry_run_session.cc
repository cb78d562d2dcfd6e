#include "editor/session/dry_run_session.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "editor/jobs/sounds.h"

namespace lararium::editor {

DryRunSession::DryRunSession(ProjectSession& project, const CastSession& cast, TaskList& tasks)
    : project_(project), cast_(cast), tasks_(tasks) {
  project_.Subscribe([this](ProjectSession::Event event) {
    if (event != ProjectSession::Event::kPlaceSelected) {
      runs_.Forget();  // The stage is another one.
    }
  });
}

void DryRunSession::Update(double seconds) {
  constexpr double kPause = 1.0;       // Seconds without edits.
  constexpr double kBehind = 30.0;     // Seconds after the last item.
  constexpr double kShortest = 240.0;  // Seconds; for a drama whose length only its script knows.
  const ScriptDocument& script = project_.script();
  const int64_t revision = script.revision();
  since_script_ = revision == seen_script_ ? since_script_ + seconds : seconds;
  seen_script_ = revision;
  if (!runs_.Stale(revision) || since_script_ < kPause || tasks_.Running(TaskKind::kOpening) ||
      cast_.pictures().PeopleLeft() > 0 || project_.document().cast.empty()) {
    return;
  }
  if (tasks_.Running(TaskKind::kDryRun)) {
    tasks_.Cancel(TaskKind::kDryRun);  // The result would be outdated.
    return;
  }
  const double length =
      std::min(std::max(script.duration() + kBehind, kShortest), drama::Drama::kMaxTime);
  runs_.Refresh(revision, TaskKind::kDryRun, tasks_,
                [former = runs_.newest(), paths = project_.paths(), length, revision,
                 document = project_.commands().snapshot(),
                 text = script.snapshot()](Progress& progress) -> Result<Played> {
                  auto missing = FindMissingSounds(paths, *document, *text);
                  auto run = RunDrama(paths, *document, "", *text, length, progress);
                  if (!run.ok() && progress.Cancelled()) {
                    return run.status();
                  }
                  Played played = former != nullptr ? *former : Played();
                  if (run.ok()) {
                    played = {*std::move(run), revision};
                  } else {
                    played.run.problems = {run.message()};
                  }
                  played.run.missing_sounds = std::move(missing);
                  return played;
                });
}

}  // namespace lararium::editor
