#pragma once

#include <cstdint>

#include "editor/check/drama_run.h"
#include "editor/jobs/background_task.h"
#include "editor/session/cached.h"
#include "editor/session/cast_session.h"
#include "editor/session/project_session.h"

namespace lararium::editor {

// Runs the drama's script in the background, shortly after each edit of the script or the stage, so
// that the panels can show what it does. Use it from the interface thread only.
class DryRunSession {
 public:
  // All arguments must outlive the session.
  DryRunSession(ProjectSession& project, const CastSession& cast, TaskList& tasks);
  DryRunSession(const DryRunSession&) = delete;
  DryRunSession& operator=(const DryRunSession&) = delete;

  // The result of the newest run; nullptr before the first one has ended. Where that run failed, it
  // has new problems and missing sounds beside the content of the run before.
  const DramaRun* newest() const { return runs_.newest() ? &runs_.newest()->run : nullptr; }
  // Changes with each run.
  int64_t number() const { return runs_.number(); }
  // Whether the newest run that did not fail played the present script.
  bool is_current() const {
    return runs_.newest() && runs_.newest()->script == project_.script().revision();
  }

  // Call once for each frame of the interface. seconds: since the last call.
  void Update(double seconds);

 private:
  struct Played {
    DramaRun run;
    int64_t script = -1;  // Revision of the script in the newest run that did not fail.
  };

  ProjectSession& project_;
  const CastSession& cast_;
  TaskList& tasks_;
  Cached<int64_t, Played> runs_;  // The key is the revision of the script.
  int64_t seen_script_ = -1;      // Revision of the script at the last Update().
  double since_script_ = 0.0;     // Seconds since the script changed.
};

}  // namespace lararium::editor
