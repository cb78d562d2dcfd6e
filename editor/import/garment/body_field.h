#pragma once

// How far from a body every place near it is: what cloth is kept out of while a
// garment is draped.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/garment/sheet.h"

namespace lararium::import {

struct FieldSample {
  float distance = 1e3f;                // metres, negative inside
  glm::vec3 outward = glm::vec3(0.0f);  // unit, or zero far from the surface
};

// A grid of signed distances, exact within a band about the surface. The sign is that
// of the nearest feature's angle-weighted normal (Baerentzen & Aanaes, "Signed Distance
// Computation Using the Angle Weighted Pseudonormal", TVCG 2005), so that small holes
// in the surface do no harm.
class BodyField {
 public:
  // Covers all that the points span, and the band around it. cell < band.
  BodyField(std::span<const glm::vec3> extent, float cell, float band);

  // Unites the field with what the surface (outward anticlockwise) encloses.
  void Add(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);
  // After the last surface: decides what is inside beyond the band.
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
  std::vector<float> distance_;  // kUnset where no surface is near
};

}  // namespace lararium::import
