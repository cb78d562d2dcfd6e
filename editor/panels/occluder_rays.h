#pragma once

// Whether a place's occluders hide points from an eye, for what is drawn over a picture.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "editor/app/workspace.h"
#include "shared/geometry/transform.h"
#include "shared/stage/place.h"
#include "shared/vision/occluders.h"

namespace lararium::panels {

class OccluderRays {
 public:
  // Once for each frame: the occluders as they are staged now. Trees of meshes that stayed are
  // kept.
  void Update(const app::Workspace& workspace);

  // Points of the world (gizmo_view.h). What lies on an occluder is not hidden by it.
  bool Hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& point) const;

 private:
  struct Occluder {
    std::shared_ptr<const vision::OccluderTree> tree;  // in the mesh's coordinates
    geometry::Similarity3 mesh_from_world;
  };
  std::shared_ptr<const stage::Place> staged_;
  std::vector<Occluder> occluders_;  // those of staged_
};

}  // namespace lararium::panels
