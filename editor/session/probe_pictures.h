#pragma once

#include <string>

#include "editor/jobs/background_task.h"
#include "editor/session/cached.h"
#include "editor/session/probe_picture.h"
#include "editor/session/project_session.h"

namespace lararium::editor {

// Reads pictures of a project's light probes in the background. Keeps the one that was asked for
// last.
class ProbePictures {
 public:
  // Both arguments must outlive the pictures.
  ProbePictures(const ProjectSession& project, TaskList& tasks)
      : project_(project), tasks_(tasks) {}

  // The picture of a probe of the document, read at the first call and again when the file changes.
  // nullptr: not read yet, or it cannot be read; see problem().
  const ProbePicture* Find(const ProbeDocument& probe);
  // Why the picture cannot be read; empty: it can, or it is being read.
  const std::string& problem() const { return picture_.problem().message(); }

 private:
  const ProjectSession& project_;
  TaskList& tasks_;
  Cached<std::string, ProbePicture> picture_;  // The key is the file's path with its stamp.
};

}  // namespace lararium::editor
