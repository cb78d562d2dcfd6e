#include "editor/panels/viewport/model_point.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "shared/geometry/glm_convert.h"

namespace lararium::panels {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::optional<ModelPoint> FindModelPoint(const geometry::TriangleMesh& mesh,
                                         const vision::OccluderTree& tree,
                                         const geometry::Similarity3& world_from_mesh,
                                         const ViewCamera& view,
                                         const Vector2d& pixel,
                                         double reach_px) {
  const geometry::Similarity3 mesh_from_world = world_from_mesh.Inverse();
  const Vector3d eye = mesh_from_world * view.camera_from_world.Center();
  std::vector<std::pair<double, Vector3d>> near;  // Distance in pixels, and the vertex.
  for (const glm::vec3& position : mesh.positions) {
    const Vector3d vertex = geometry::ToEigen(position);
    const auto seen = view.Project(world_from_mesh * vertex);
    if (seen && (*seen - pixel).norm() <= reach_px) {
      near.emplace_back((*seen - pixel).norm(), vertex);
    }
  }
  std::sort(near.begin(), near.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [off, vertex] : near) {
    const double bias = 1e-3 * (vertex - eye).norm();
    if (!tree.Hides(eye.cast<float>(), vertex.cast<float>(), static_cast<float>(bias))) {
      return ModelPoint{vertex, true};
    }
  }
  const Ray ray = view.RayThrough(pixel);
  const Vector3d direction = (mesh_from_world.rotation * ray.direction).normalized();
  const auto hit = tree.FirstHit(eye.cast<float>(), direction.cast<float>(), 0.0f,
                                 std::numeric_limits<float>::max());
  if (!hit) {
    return std::nullopt;
  }
  return ModelPoint{eye + static_cast<double>(hit->distance) * direction, false};
}

}  // namespace lararium::panels
