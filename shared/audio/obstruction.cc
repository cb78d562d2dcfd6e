#include "shared/audio/obstruction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace lararium::audio {
namespace {

constexpr float kSourceRadius = 0.2f;  // metres
constexpr float kBias = 0.05f;

Eigen::Vector3f ToEigen(const glm::vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

SoundBlockers::SoundBlockers(std::span<const stage::Occluder> occluders) {
  for (const stage::Occluder& occluder : occluders) {
    if (occluder.blocks_sound) {
      trees_.emplace_back(vision::Placed(occluder.mesh, occluder.stage_from_mesh));
    }
  }
}

float SoundBlockers::Obstruction(const glm::vec3& ear, const glm::vec3& source) const {
  const glm::vec3 way = source - ear;
  const float distance = glm::length(way);
  if (trees_.empty() || distance < 1e-3f) {
    return 0.0f;
  }
  const glm::vec3 ahead = way / distance;
  const glm::vec3 other =
      std::abs(ahead.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
  const glm::vec3 right = glm::normalize(glm::cross(ahead, other));
  const glm::vec3 up = glm::cross(right, ahead);
  const float radius = std::min(kSourceRadius, 0.5f * distance);
  const std::array<glm::vec3, 5> points = {source, source + radius * right, source - radius * right,
                                           source + radius * up, source - radius * up};
  int blocked = 0;
  for (const glm::vec3& point : points) {
    blocked += std::any_of(trees_.begin(), trees_.end(), [&](const vision::OccluderTree& tree) {
      return tree.Hides(ToEigen(ear), ToEigen(point), kBias);
    });
  }
  return static_cast<float>(blocked) / static_cast<float>(points.size());
}

}  // namespace lararium::audio
