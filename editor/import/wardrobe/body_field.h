#pragma once

// Signed distance to a body, which keeps cloth out of it while a garment is draped.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/wardrobe/sheet.h"

namespace lararium::import {

struct FieldSample {
  float distance = 1e3f;                // Metres, negative inside.
  glm::vec3 outward = glm::vec3(0.0f);  // Unit vector, or zero far from the surface.
};

// A grid of signed distances, exact within a band about the surface. The sign is that of the
// angle-weighted normal of the nearest feature (Baerentzen & Aanaes, "Signed Distance
// Computation Using the Angle Weighted Pseudonormal", TVCG 2005), so that small holes in the
// surface are harmless.
class BodyField {
 public:
  // Covers the bounding box of the points and the band around it. Requires cell < band.
  BodyField(std::span<const glm::vec3> extent, float cell, float band);

  // Adds the volume that the surface encloses. Its triangles are counter-clockwise from
  // outside.
  void Add(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);
  // Call after the last surface: decides which cells beyond the band are inside.
  void Finish();

  FieldSample Sample(const glm::vec3& point) const;

 private:
  size_t Index(int x, int y, int z) const {
    return (size_t(z) * size_[1] + size_t(y)) * size_[0] + size_t(x);
  }
  void AddTriangle(const struct FieldTriangle& triangle);

  glm::vec3 origin_;
  float cell_;
  float band_;
  int size_[3];
  std::vector<float> distance_;  // kUnset if no surface is near.
};

}  // namespace lararium::import
