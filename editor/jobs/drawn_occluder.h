#pragma once

// Occluders that were drawn on training images: the corners of a face, triangulated in the map.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/stage/picks.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

struct DrawnOccluder {
  // In map units. Counter-clockwise as seen from the images in which it was drawn. The renderer
  // draws occluders from both sides.
  geometry::TriangleMesh mesh_in_map;
  std::vector<stage::AnchorReport> corners;
  double error_px = 0.0;  // Root mean square reprojection error of all picks.
  // Largest distance of a corner from the plane that fits all corners best (least squares), before
  // they are projected onto it; map units.
  double unevenness = 0.0;
};

// The face, made plane if the document says so. With a depth, it becomes a prism that extends
// behind the face, away from the images in which it was drawn. map_units_per_metre: converts the
// depth. Errors name the corner and what to pick: fewer than three corners, a corner picked in
// fewer than two images or from almost the same direction, collinear corners, edges that cross.
Result<DrawnOccluder> DrawOccluder(const OccluderDocument& occluder,
                                   const vision::SceneDatabase& map,
                                   double map_units_per_metre);

// The place without drawn occluders that are not complete.
PlaceDocument WithoutDrafts(PlaceDocument place, const vision::SceneDatabase& map);

// The functions below support drawing. The first image adds the corners; in other images the user
// picks the same corners in turn.
//
// Returns the pick of an anchor in an image; nullptr where there is none.

const stage::Pick* PickIn(const stage::Anchor& anchor, const vision::Keyframe& keyframe);
// The corner that the next click in an image sets; corners.size(): a new one; nullopt: all corners
// are set, or the limit is reached.
std::optional<size_t> NextCorner(const OccluderDocument& occluder,
                                 const vision::Keyframe& keyframe);
// The corner in an image that is nearest to a pixel, within reach_px.
std::optional<size_t> CornerNear(const OccluderDocument& occluder,
                                 const vision::Keyframe& keyframe,
                                 const Eigen::Vector2d& pixel,
                                 double reach_px);
// Sets a corner's pick. corner == corners.size() adds a corner.
void SetCorner(OccluderDocument& occluder,
               size_t corner,
               const vision::Keyframe& keyframe,
               const Eigen::Vector2d& pixel);

}  // namespace lararium::editor
