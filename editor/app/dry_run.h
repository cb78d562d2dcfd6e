#pragma once

// The drama run without pictures, to find what is wrong with it: in each of its languages,
// for nobody and for each visitor that was recorded.

#include <vector>

#include "editor/app/lines.h"
#include "editor/app/options.h"
#include "editor/app/project.h"
#include "shared/core/json.h"
#include "shared/core/progress.h"
#include "shared/core/sentence.h"

namespace lararium::app {

struct DryRunReport {
  std::vector<Sentence> problems;  // each with its place in the script, where it has one
  Json tasks = Json::array();      // of the first run: what everybody did when
  Json seeks = Json::object();
  Json runs = Json::array();  // each run's language and visitor
};

// Runs it once for each spoken language without a visitor, and for each visitor in
// PROJECT/visitors/*.visitor and in the options. What several runs find is told once. On a
// stage that lacks anything a drama would tell nothing that is true, and is not run.
DryRunReport DryRunAll(const ProjectPaths& paths,
                       const ProjectDocument& document,
                       const ProjectLines& lines,
                       const CheckOptions& options,
                       Progress& progress);

}  // namespace lararium::app
