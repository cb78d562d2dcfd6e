#pragma once

// A BodyCapsule in motion: the hull of two spheres, which cloth and hair may not enter.

#include <algorithm>
#include <cmath>

#include "shared/human/float4.h"

namespace lararium::human {

struct RoundCone {
  Float4 a;         // centre of the first sphere
  Float4 axis;      // unit vector towards the second sphere
  Float4 motion_a;  // motion of both centres during the step
  Float4 motion_b;
  float length = 0.0f;
  float radius = 0.0f;      // radius of the first sphere
  float slope = 0.0f;       // radius gained per metre of axis
  float lean = 0.0f;        // Backward lean of the surface normal per metre of distance.
  float inv_length = 0.0f;  // 1 / length; 0 for a sphere
};

// radius_a and radius_b are the radii of the spheres around a and b.
inline RoundCone MakeRoundCone(const Float4& a, const Float4& b, float radius_a, float radius_b) {
  RoundCone cone;
  const Float4 along = b - a;
  const float length = Length(along);
  const float difference = radius_b - radius_a;
  if (length <= std::abs(difference) + 1e-6f) {  // one sphere holds the other
    cone.a = radius_a >= radius_b ? a : b;
    cone.radius = std::max(radius_a, radius_b);
    return cone;
  }
  cone.a = a;
  cone.length = length;
  cone.inv_length = 1.0f / length;
  cone.axis = along * cone.inv_length;
  cone.radius = radius_a;
  cone.slope = difference * cone.inv_length;
  cone.lean = cone.slope / std::sqrt(1.0f - cone.slope * cone.slope);
  return cone;
}

// The nearest of all spheres whose union is the hull.
struct NearestSphere {
  Float4 from_centre;     // vector from the centre to the point
  float distance = 0.0f;  // length of from_centre
  float radius = 0.0f;
  float along = 0.0f;  // Position of the centre between a (0) and b (1).
};

inline NearestSphere FindNearestSphere(const RoundCone& cone, const Float4& point) {
  const Float4 from_a = point - cone.a;
  const float height = Dot(from_a, cone.axis);
  const float aside = std::sqrt(std::max(Dot(from_a, from_a) - height * height, 0.0f));
  const float centre = std::clamp(height + aside * cone.lean, 0.0f, cone.length);
  NearestSphere sphere;
  sphere.from_centre = from_a - cone.axis * centre;
  sphere.distance = Length(sphere.from_centre);
  sphere.radius = cone.radius + cone.slope * centre;
  sphere.along = centre * cone.inv_length;
  return sphere;
}

}  // namespace lararium::human
