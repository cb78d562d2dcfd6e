#pragma once

// Solids given by signed distance functions, and their triangulation. The fields need to be
// only approximately Euclidean: positive outside, negative inside, smooth near the surface.

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/geometry/triangle_mesh.h"

namespace lararium::import {

using DistanceField = std::function<float(const glm::vec3&)>;

// Union and intersection with a fillet of the given radius (Inigo Quilez's
// polynomial smooth minimum). Subtracting b from a is SmoothIntersection(a, -b).
float SmoothUnion(float a, float b, float radius);
float SmoothIntersection(float a, float b, float radius);

// The convex hull of two spheres, accurate to first order in the difference of radii.
float RoundCone(
    const glm::vec3& point, const glm::vec3& a, float radius_a, const glm::vec3& b, float radius_b);

// Distance to an axis-aligned ellipsoid, exact to first order at its surface.
float Ellipsoid(const glm::vec3& point, const glm::vec3& center, const glm::vec3& radii);

// A solid through superelliptical cross-sections along a straight axis, joined by cubic Hermite
// splines: limbs, trunks, garments.
class Loft {
 public:
  struct Station {
    float t;                // Along the axis, increasing.
    glm::vec2 center;       // Position in the plane across the axis.
    glm::vec2 radii;        // half extents
    float exponent = 2.0f;  // 2 is an ellipse; larger is squarer.
  };

  // The columns of actor_from_loft are: across, along the axis, across.
  Loft(const glm::vec3& origin, const glm::mat3& actor_from_loft, std::vector<Station> stations);

  // Distance with ends that are rounded by the given fillet.
  float Distance(const glm::vec3& point, float end_fillet) const;
  // Distance without ends.
  float SideDistance(const glm::vec3& point) const;

 private:
  Station At(float t) const;

  glm::vec3 origin_;
  glm::mat3 loft_from_actor_;
  std::vector<Station> stations_;
  std::vector<Station> slopes_;  // Derivatives of center and radii over t.
};

// The unit gradient, by finite differences.
glm::vec3 FieldNormal(const DistanceField& field, const glm::vec3& point);

struct Box {
  glm::vec3 low;
  glm::vec3 high;
};

// Triangulates the zero set inside the box as a closed surface with normals by surface nets
// (Gibson, "Constrained Elastic Surface Nets", MICCAI 1998); the vertices are then spread
// evenly and projected onto the surface. The solid must be inside the box and should be thicker
// than the cells.
geometry::TriangleMesh Polygonise(const DistanceField& field, const Box& box, float cell);

}  // namespace lararium::import
