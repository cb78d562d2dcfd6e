#pragma once

// Which point of a model the pointer means.

#include <Eigen/Core>
#include <optional>

#include "editor/panels/view_camera.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/vision/occluders.h"

namespace lararium::panels {

struct ModelPoint {
  Eigen::Vector3d on_mesh = Eigen::Vector3d::Zero();  // in the mesh's axes and unit
  bool vertex = false;                                // otherwise somewhere on its surface
};

// The vertex nearest to a pixel of the view, within reach_px of it, of those that the model itself
// does not hide; without any, where the ray through the pixel meets the surface. nullopt where it
// meets none. tree: of the mesh, in its coordinates.
std::optional<ModelPoint> FindModelPoint(const geometry::TriangleMesh& mesh,
                                         const vision::OccluderTree& tree,
                                         const geometry::Similarity3& world_from_mesh,
                                         const ViewCamera& view,
                                         const Eigen::Vector2d& pixel,
                                         double reach_px);

}  // namespace lararium::panels
