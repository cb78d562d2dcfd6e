#pragma once

// Whether occluders hide points from an eye, for objects that are drawn over a picture.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "editor/session/workspace.h"
#include "shared/geometry/transform.h"
#include "shared/stage/place.h"
#include "shared/vision/occluders.h"

namespace lararium::panels {

class OccluderRays {
 public:
  // Call once per frame. Updates the occluders to the present staging, and keeps the trees of
  // meshes that did not change.
  void Update(const editor::Workspace& workspace);

  // Both points in the world frame (gizmo_view.h). An occluder does not hide points on its surface.
  bool Hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& point) const;

 private:
  struct Occluder {
    std::shared_ptr<const vision::OccluderTree> tree;  // Coordinates of the mesh.
    geometry::Similarity3 mesh_from_world;
  };
  std::shared_ptr<const stage::Place> staged_;
  std::vector<Occluder> occluders_;  // The occluders of staged_.
};

}  // namespace lararium::panels
