#pragma once

// Occluders that were drawn on training images: the corners of a face, located in the map.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "editor/app/project.h"
#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

struct DrawnOccluder {
  // In the map, whatever its unit. Counter-clockwise from where it was drawn. Both faces hide:
  // occluders are drawn from either side.
  geometry::TriangleMesh mesh_in_map;
  std::vector<stage::AnchorReport> corners;
  double error_px = 0.0;  // root mean square reprojection error of all picks
  // Farthest that a corner lies off the plane that fits them best (least squares), before any is
  // laid onto it; map units.
  double unevenness = 0.0;
};

// The face, flat where the document says so, and, with a depth, a prism behind it, away from where
// it was drawn. map_units_per_metre: for the depth. Errors name the corner and what to pick: fewer
// than three corners, one picked in fewer than two images or from almost the same direction,
// corners on a line, edges that cross.
Result<DrawnOccluder> DrawOccluder(const OccluderDocument& occluder,
                                   const vision::SceneDatabase& map,
                                   double map_units_per_metre);

// The place without occluders that are not drawn to their end.
PlaceDocument WithoutDrafts(PlaceDocument place, const vision::SceneDatabase& map);

// Drawing. The corners are added in the first image; in others the same ones are set in turn.

// Where an anchor was picked in an image; nullptr: nowhere.
const stage::Pick* PickIn(const stage::Anchor& anchor, const vision::Keyframe& keyframe);
// The corner that the next click in an image sets; corners.size(): a new one; nothing: all are
// set, or there are too many.
std::optional<size_t> NextCorner(const OccluderDocument& occluder,
                                 const vision::Keyframe& keyframe);
// The nearest corner picked in an image within reach_px of a pixel.
std::optional<size_t> CornerNear(const OccluderDocument& occluder,
                                 const vision::Keyframe& keyframe,
                                 const Eigen::Vector2d& pixel,
                                 double reach_px);
// corner: at most corners.size(), which adds one.
void SetCorner(OccluderDocument& occluder,
               size_t corner,
               const vision::Keyframe& keyframe,
               const Eigen::Vector2d& pixel);

}  // namespace lararium::app
