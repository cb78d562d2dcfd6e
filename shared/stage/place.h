#pragma once

// A real place on which dramas are staged: how its map lies under the stage,
// what hides people there, and the light that falls on them.

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

// Something real that hides what is behind it; drawn into depth only. What else it does:
struct Occluder {
  std::string name;
  geometry::TriangleMesh mesh;
  geometry::Similarity3 stage_from_mesh;  // the mesh may be modelled in any unit
  bool blocks_sound = true;
  bool blocks_walking = true;   // nobody walks through it
  bool receives_shadow = true;  // people darken it, and the drama's lamps brighten it
};

struct Place {
  std::string name;
  // The stage: metres, right-handed, Y up, -Z forward. The map: as trained.
  geometry::Similarity3 map_from_stage;
  // Moves the camera along its own axes, in metres: x right, y down, z forward.
  Eigen::Vector3d camera_nudge = Eigen::Vector3d::Zero();
  std::vector<Occluder> occluders;
  std::vector<light::PlacedProbe> probes;  // light in stage axes; none: dark
  // Of the camera that films it, where it was measured: people are made alike.
  std::optional<light::CameraTraits> camera = std::nullopt;
  Acoustics acoustics;
};

// The pose from which the stage is drawn: rigid and metric, nudge applied.
geometry::Rigid3 CameraFromStage(const Place& place, const geometry::Rigid3& camera_from_map);

// Whether the same things are in people's way at both.
bool BlockWalkingAlike(const Place& a, const Place& b);

}  // namespace lararium::stage
