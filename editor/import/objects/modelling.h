#pragma once

// A small workshop: surfaces turned on a wheel, drawn along a path, or sawn from
// wood, each painted vertex by vertex. All in metres, Y up; texture coordinates are
// metres, or turns round what is round.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/objects/paint.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// A point of the outline of something turned about +Y.
struct OutlinePoint {
  float radius;  // metres; 0 closes the surface
  float height;
  bool corner = false;  // the outline bends sharply here, instead of running smoothly through
};

// The outline goes round the solid with its outside on the right hand, from the
// foot up and, for hollow things, over the rim and down inside. irregularity: how
// far hand work is from round, metres.
stage::PropMesh Turned(std::span<const OutlinePoint> outline,
                       const Paint& paint,
                       float irregularity = 0.0f);

// A rod of round section along a smooth path through points; closed at its ends.
struct PathPoint {
  glm::vec3 position;
  float radius;
};
stage::PropMesh Rod(std::span<const PathPoint> path, const Paint& paint);

// A block with rounded edges.
stage::PropMesh Block(const glm::vec3& low, const glm::vec3& high, float edge, const Paint& paint);

// Adds a copy of mesh, moved by to_from_mesh.
void Append(const stage::PropMesh& mesh, stage::PropMesh& to, const stage::Pose& to_from_mesh = {});

}  // namespace lararium::import
