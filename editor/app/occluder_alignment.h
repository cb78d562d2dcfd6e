#pragma once

// Occluders that are models, laid where the real thing is: by points of the model that were picked
// in the training images too, and by the map's points on its surface.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/train/mesh_alignment.h"
#include "shared/core/json.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

// How well one pair fits, as the model lies.
struct ModelPairReport {
  bool located = false;  // in the map; otherwise problem says why not
  Status problem;
  stage::AnchorReport anchor;
  Eigen::Vector3d on_stage = Eigen::Vector3d::Zero();  // where it was picked, stage metres
  double distance_m = 0.0;                             // from there to the model's point
  // Root mean square over the images, from the pick to where the model's point is seen.
  double distance_px = 0.0;
};

struct AlignmentReport {
  std::vector<ModelPairReport> pairs;  // as in the document
  int located = 0;
  // The located one that is farthest off; none where that says nothing: fewer than four pairs share
  // what is left over evenly.
  std::optional<size_t> worst;
  double rms_m = 0.0;
  double rms_px = 0.0;
};

AlignmentReport ReportAlignment(const OccluderDocument& occluder,
                                const vision::SceneDatabase& map,
                                const geometry::Similarity3& map_from_stage);

// stage_from_mesh by the pairs that the map locates; see train::AlignByPairs.
Result<geometry::Similarity3> AlignByPoints(const OccluderDocument& occluder,
                                            const vision::SceneDatabase& map,
                                            const geometry::Similarity3& map_from_stage);

// By the map's points; see train::RefineAlignment. search_m: stage metres.
Result<train::RefineReport> RefineOnMap(const OccluderDocument& occluder,
                                        const geometry::TriangleMesh& mesh,
                                        const vision::SceneDatabase& map,
                                        const geometry::Similarity3& map_from_stage,
                                        double search_m,
                                        Progress& progress);

inline constexpr double kMinSearch = 0.001;  // metres
inline constexpr double kMaxSearch = 10.0;

// What came of it, in a sentence or two; in the language of the interface, or untranslated.
std::string RefineText(const train::RefineReport& report, bool translated);

// docs/file-formats.md.
Json AlignmentJson(const OccluderDocument& occluder, const AlignmentReport& report);
Json RefineJson(const train::RefineReport& report);
std::string AlignmentText(const AlignmentReport& report);

// Edits. Removing renames those behind it.
void AddModelPair(OccluderDocument& occluder, const Eigen::Vector3d& on_mesh);
void SetModelPick(OccluderDocument& occluder, size_t pair, const stage::Pick& pick);
void RemoveModelPair(OccluderDocument& occluder, size_t pair);
// As another place may take it over, whose images are others.
OccluderDocument WithoutPicks(OccluderDocument occluder);

}  // namespace lararium::app
