#pragma once

// Reports how accurately the stage of a place is known, as text and JSON: the source of its
// scale and its uncertainty, the picks, the floor, the check points.

#include <string>

#include "editor/document/project.h"
#include "editor/jobs/check_points.h"
#include "editor/jobs/staging.h"
#include "shared/core/json.h"

namespace lararium::editor {

// {"scale": {"from": "picks" | "tags" | "nothing", "metres_per_unit", ...},
//  "picks": [...], "floor": {...} | null}; docs/file-formats.md.
Json StageJson(const PlaceDocument& place,
               const MapMeasures& measures,
               const ResolvedPicks& resolved);

// The same data as a few lines of text.
std::string StageText(const PlaceDocument& place,
                      const MapMeasures& measures,
                      const ResolvedPicks& resolved);

struct StageReport {
  std::string text;
  Json json;
  CheckReport points;
};

// Includes the check points of the project, if it has any.
StageReport ReportStage(const ProjectDocument& document,
                        const PlaceDocument& place,
                        const StagedMap& map);

}  // namespace lararium::editor
