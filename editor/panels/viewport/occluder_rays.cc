#include "editor/panels/viewport/occluder_rays.h"

#include <algorithm>
#include <utility>

#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/overlay_mesh.h"

namespace lararium::panels {

void OccluderRays::Update(const editor::Workspace& workspace) {
  const std::shared_ptr<const stage::Place>& staged = workspace.preview().staged();
  if (staged != staged_) {
    std::vector<Occluder> occluders(staged != nullptr ? staged->occluders.size() : 0);
    for (size_t i = 0; i < occluders.size(); ++i) {
      const geometry::TriangleMesh& mesh = staged->occluders[i].mesh;
      const bool same = i < occluders_.size() && SameMesh(mesh, staged_->occluders[i].mesh);
      occluders[i].tree =
          same ? std::move(occluders_[i].tree)
               : std::make_shared<const vision::OccluderTree>(vision::Placed(mesh, {}));
    }
    occluders_ = std::move(occluders);
    staged_ = staged;
  }
  for (size_t i = 0; i < occluders_.size(); ++i) {
    occluders_[i].mesh_from_world =
        WorldFromOccluder(workspace, staged_->occluders[i].name).Inverse();
  }
}

bool OccluderRays::Hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& point) const {
  constexpr double kBias = 0.03;  // World units behind a surface.
  return std::any_of(occluders_.begin(), occluders_.end(), [&](const Occluder& occluder) {
    const geometry::Similarity3& to_mesh = occluder.mesh_from_world;
    return occluder.tree->Hides((to_mesh * eye).cast<float>(), (to_mesh * point).cast<float>(),
                                static_cast<float>(kBias * to_mesh.scale));
  });
}

}  // namespace lararium::panels
