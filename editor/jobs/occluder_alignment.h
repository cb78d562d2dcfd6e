#pragma once

// Alignment of a model with the real object: by points of the model that were also picked in the
// training images, and by the map's points on its surface.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "editor/train/mesh_alignment.h"
#include "shared/core/json.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

// The error of one pair with the model's present alignment.
struct ModelPairReport {
  // Whether the picks locate the point in the map; otherwise problem gives the reason.
  bool located = false;
  Status problem;
  stage::AnchorReport anchor;
  Eigen::Vector3d on_stage = Eigen::Vector3d::Zero();  // The located point, stage metres.
  double distance_m = 0.0;  // Distance from on_stage to the model's point.
  // Root mean square over the images: distance from the pick to the projection of the model's
  // point.
  double distance_px = 0.0;
};

struct AlignmentReport {
  std::vector<ModelPairReport> pairs;  // Same order as in the document.
  int located = 0;
  // The located pair with the largest error. Not set with fewer than four pairs, which share the
  // residual evenly.
  std::optional<size_t> worst;
  double rms_m = 0.0;
  double rms_px = 0.0;
};

AlignmentReport ReportAlignment(const OccluderDocument& occluder,
                                const vision::SceneDatabase& map,
                                const geometry::Similarity3& map_from_stage);

// Computes stage_from_mesh from the located pairs; see train::AlignByPairs.
Result<geometry::Similarity3> AlignByPoints(const OccluderDocument& occluder,
                                            const vision::SceneDatabase& map,
                                            const geometry::Similarity3& map_from_stage);

// Refines the alignment with the map's points; see train::RefineAlignment. search_m: stage metres.
Result<train::RefineReport> RefineOnMap(const OccluderDocument& occluder,
                                        const geometry::TriangleMesh& mesh,
                                        const vision::SceneDatabase& map,
                                        const geometry::Similarity3& map_from_stage,
                                        double search_m,
                                        Progress& progress);

inline constexpr double kMinSearch = 0.001;  // Limits of search_m, metres.
inline constexpr double kMaxSearch = 10.0;

// The result in one or two sentences. translated: in the language of the interface; otherwise
// English.
std::string RefineText(const train::RefineReport& report, bool translated);

// See docs/file-formats.md.
Json AlignmentJson(const OccluderDocument& occluder, const AlignmentReport& report);
Json RefineJson(const train::RefineReport& report);
std::string AlignmentText(const AlignmentReport& report);

// Edits. Removing a pair renames the pairs after it.
void AddModelPair(OccluderDocument& occluder, const Eigen::Vector3d& on_mesh);
void SetModelPick(OccluderDocument& occluder, size_t pair, const stage::Pick& pick);
void RemoveModelPair(OccluderDocument& occluder, size_t pair);

}  // namespace lararium::editor
