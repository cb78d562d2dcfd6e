#pragma once

// Picking of a model's points with the pointer.

#include <Eigen/Core>
#include <optional>

#include "editor/panels/viewport/view_camera.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/vision/occluders.h"

namespace lararium::panels {

struct ModelPoint {
  Eigen::Vector3d on_mesh = Eigen::Vector3d::Zero();  // Axes and unit of the mesh.
  bool vertex = false;                                // A vertex; otherwise a point of the surface.
};

// The vertex nearest to a pixel of the view within reach_px that the model does not hide. Without
// one, the intersection of the pixel's ray with the surface; nullopt where it misses. tree: of the
// mesh, in its coordinates.
std::optional<ModelPoint> FindModelPoint(const geometry::TriangleMesh& mesh,
                                         const vision::OccluderTree& tree,
                                         const geometry::Similarity3& world_from_mesh,
                                         const ViewCamera& view,
                                         const Eigen::Vector2d& pixel,
                                         double reach_px);

}  // namespace lararium::panels
