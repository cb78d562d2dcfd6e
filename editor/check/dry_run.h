#pragma once

// Runs the drama without pictures to find its problems: in each of its languages, without a
// visitor and with each recorded visitor.

#include <vector>

#include "editor/document/project.h"
#include "editor/jobs/lines.h"
#include "shared/core/json.h"
#include "shared/core/progress.h"
#include "shared/core/sentence.h"

namespace lararium::editor {

struct CheckOptions {
  std::filesystem::path project;
  double seconds = 300.0;  // Seconds of the drama to run.
  int seeks = 0;  // Seeks to random times after the run, whose result is compared with the run.
  // Recorded visitors in addition to those of the project.
  std::vector<std::filesystem::path> visitors = {};
};

struct DryRunReport {
  std::vector<Sentence> problems;  // Include the location in the script, if any.
  Json tasks = Json::array();      // Tasks of the first run.
  Json seeks = Json::object();
  Json runs = Json::array();  // Language and visitor of each run.
};

// Runs the drama once for each spoken language without a visitor, and once for each visitor in
// PROJECT/visitors/*.visitor and in the options. A problem of several runs is reported once. If
// content of the stage is missing, the drama is not run, because its results would be wrong.
DryRunReport DryRunAll(const ProjectPaths& paths,
                       const ProjectDocument& document,
                       const ProjectLines& lines,
                       const CheckOptions& options,
                       Progress& progress);

}  // namespace lararium::editor
