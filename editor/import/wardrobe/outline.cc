#include "editor/import/wardrobe/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

namespace lararium::import {

Outline::Outline(const FittedBody& body,
                 const PosedBody& posed,
                 std::span<const Sheet* const> worn,
                 bool left_arm) {
  const std::vector<float> arm = ArmShare(body);
  const std::vector<float> head = HeadShare(body);
  const std::vector<bool> is_body = IsBody(body);
  std::vector<std::vector<glm::vec2>> slabs;
  const auto add = [&](const glm::vec3& p) {
    const size_t level = static_cast<size_t>(std::max(0.0f, p.y) / kLevel);
    slabs.resize(std::max(slabs.size(), level + 2));
    // A point counts at its level and the two below, not above, because shoulders are round.
    for (size_t at = level > 1 ? level - 2 : 0; at <= level; ++at) {
      slabs[at].emplace_back(p.x, p.z);
    }
  };
  for (size_t v = 0; v < posed.positions.size(); ++v) {
    const bool wrapped_arm = left_arm && body.base.positions[v].x < 0.0f && !posed.forearm[v];
    if (is_body[v] && head[v] < 0.5f && (arm[v] < 0.3f || wrapped_arm)) {
      add(posed.positions[v]);
    }
  }
  const float free_side = JointPlace(body, posed, "r_shoulder").x;
  const glm::vec3 waist = JointPlace(body, posed, "vl1");
  for (const Sheet* sheet : worn) {
    for (const glm::vec3& p : sheet->positions) {
      if (p.x < (p.y > waist.y - 0.1f ? 0.8f : 1.1f) * free_side) {
        add(p);
      }
    }
  }
  middle_ = {0.0f, waist.z - 0.02f};
  for (std::vector<glm::vec2>& slab : slabs) {
    radius_.push_back(slab.empty() ? std::vector<float>(kAngles, 0.0f)
                                   : HullRadius(slab, middle_, kAngles));
  }
}

float Outline::Radius(float angle, float height) const {
  const float level = std::clamp(height / kLevel - 0.5f, 0.0f, float(radius_.size() - 1) - 0.01f);
  const size_t at = static_cast<size_t>(level);
  return glm::mix(AtLevel(at, angle), AtLevel(at + 1, angle), level - float(at));
}

float Outline::Hanging(float angle, float from, float height) const {
  float radius = 0.0f;
  for (float y = from; y > height - 1e-4f; y -= kLevel) {
    radius = std::max(Radius(angle, y), radius - 0.22f * kLevel);
  }
  return radius;
}

glm::vec3 Outline::Place(float angle, float radius, float height) const {
  return {middle_.x + radius * std::sin(angle), height, middle_.y + radius * std::cos(angle)};
}

float Outline::AngleOf(const glm::vec3& place) const {
  return std::atan2(place.x - middle_.x, place.z - middle_.y);
}

float Outline::AtLevel(size_t level, float angle) const {
  float turn = angle / glm::two_pi<float>();
  turn = (turn - std::floor(turn)) * kAngles;
  const int k = static_cast<int>(turn) % kAngles;
  const std::vector<float>& radius = radius_[level];
  return glm::mix(radius[k], radius[(k + 1) % kAngles], turn - std::floor(turn));
}

}  // namespace lararium::import
