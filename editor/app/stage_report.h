#pragma once

// How well the stage of a place is known, for people and for scripts: where its
// metres come from and how far off they may be, the picks, the floor, the check points.

#include <string>

#include "editor/app/check_points.h"
#include "editor/app/project.h"
#include "editor/app/staging.h"
#include "shared/core/json.h"

namespace lararium::app {

// {"scale": {"from": "picks" | "tags" | "nothing", "metres_per_unit", ...},
//  "picks": [...], "floor": {...} | null}; docs/file-formats.md.
Json StageJson(const PlaceDocument& place,
               const MapMeasures& measures,
               const ResolvedPicks& resolved);

// The same in a few lines.
std::string StageText(const PlaceDocument& place,
                      const MapMeasures& measures,
                      const ResolvedPicks& resolved);

struct StageReport {
  std::string text;
  Json json;
  CheckReport points;
};

// The same with the check points of the project, if it has any.
StageReport ReportStage(const ProjectDocument& document,
                        const PlaceDocument& place,
                        const StagedMap& map);

}  // namespace lararium::app
