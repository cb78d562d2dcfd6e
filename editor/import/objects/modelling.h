#pragma once

// Modelling tools: surfaces turned on a wheel, rods along a path, wooden blocks, each painted
// vertex by vertex. All in metres, Y up; texture coordinates are metres, or turns around round
// parts.

#include <glm/vec3.hpp>
#include <span>

#include "editor/import/objects/paint.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// A point of the outline of a surface turned about +Y.
struct OutlinePoint {
  float radius;  // Metres; 0 closes the surface.
  float height;
  bool corner = false;  // The outline has a sharp bend here instead of a smooth curve.
};

// The outline goes around the solid with the outside on its right: from the foot up and, for
// hollow objects, over the rim and down inside. `irregularity` is the deviation of hand work
// from a circle, metres.
stage::PropMesh Turned(std::span<const OutlinePoint> outline,
                       const Paint& paint,
                       float irregularity = 0.0f);

// A rod with a round section along a smooth path through points, closed at its ends.
struct PathPoint {
  glm::vec3 position;
  float radius;
};
stage::PropMesh Rod(std::span<const PathPoint> path, const Paint& paint);

// A block with rounded edges.
stage::PropMesh Block(const glm::vec3& low, const glm::vec3& high, float edge, const Paint& paint);

// Appends a copy of `mesh`, transformed by `to_from_mesh`.
void Append(const stage::PropMesh& mesh, stage::PropMesh& to, const stage::Pose& to_from_mesh = {});

}  // namespace lararium::import
