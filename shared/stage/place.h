#pragma once

// A real place where dramas are staged: the transform from stage to map, the occluders, the light
// and the acoustics.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/light/camera_traits.h"
#include "shared/light/probe_blend.h"
#include "shared/stage/acoustics.h"

namespace lararium::stage {

// A real object that hides what is behind it. It is drawn into the depth buffer only.
struct Occluder {
  std::string name;
  geometry::TriangleMesh mesh;
  geometry::Similarity3 stage_from_mesh;  // The mesh may be modelled in any unit.
  bool blocks_sound = true;
  bool blocks_walking = true;   // Actors cannot walk through it.
  bool receives_shadow = true;  // Actors cast shadows on it, and the drama's lamps light it.
};

struct Place {
  std::string name;
  // Stage frame: metres, right-handed, Y up, -Z forward. The map frame is that of the training.
  geometry::Similarity3 map_from_stage;
  // Moves the camera along its own axes, in metres: x right, y down, z forward.
  Eigen::Vector3d camera_nudge = Eigen::Vector3d::Zero();
  std::vector<Occluder> occluders;
  std::vector<light::PlacedProbe> probes;  // Light, in stage axes; empty: dark.
  // Measured noise and blur of the camera that films the place; drawn people are matched to it.
  std::optional<light::CameraTraits> camera = std::nullopt;
  Acoustics acoustics;
};

// Pose from which the stage is drawn: rigid, metric and with the nudge applied.
geometry::Rigid3 CameraFromStage(const Place& place, const geometry::Rigid3& camera_from_map);
// The pose in the map for which CameraFromStage() returns camera_from_stage.
geometry::Rigid3 CameraFromMap(const Place& place, const geometry::Rigid3& camera_from_stage);

// Whether both places have the same occluders that block walking.
bool BlockWalkingAlike(const Place& a, const Place& b);

}  // namespace lararium::stage
