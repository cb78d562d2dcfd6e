#include "shared/human/level_of_detail.h"

#include <algorithm>
#include <cmath>

namespace lararium::human {
namespace {

// With the same weight for skin as for other surfaces, faces were blurred at the lowest quality.
constexpr float kOfFaces = 2.5f;
constexpr float kElsewhere = 0.5f;

bool AreTriangles(const std::vector<uint32_t>& indices, size_t vertex_count) {
  return indices.size() % 3 == 0 &&
         std::all_of(indices.begin(), indices.end(),
                     [vertex_count](uint32_t i) { return i < vertex_count; });
}

}  // namespace

float ErrorShare(Surface surface) {
  const bool of_a_face = surface == Surface::kSkin || surface == Surface::kEye;
  return of_a_face ? kOfFaces : kElsewhere;
}

Status ValidateTriangles(const std::vector<uint32_t>& indices,
                         const std::vector<LevelOfDetail>& coarser,
                         size_t vertex_count,
                         const std::string& where) {
  const auto can_be_detail = [](const LevelOfDetail& level) {
    return std::isfinite(level.error) && level.error >= 0.0f;
  };
  if (!AreTriangles(indices, vertex_count) ||
      std::any_of(coarser.begin(), coarser.end(), [vertex_count](const LevelOfDetail& level) {
        return !AreTriangles(level.indices, vertex_count);
      })) {
    return Status::Error(where, "its triangles name vertices that do not exist");
  }
  if (!std::all_of(coarser.begin(), coarser.end(), can_be_detail)) {
    return Status::Error(where, "a level of detail has an invalid error value");
  }
  return Status();
}

}  // namespace lararium::human
