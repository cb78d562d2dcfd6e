#include "editor/import/wardrobe/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

#include "shared/core/check.h"

namespace lararium::import {

Outline::Outline(const FittedBody& body,
                 const PosedBody& posed,
                 std::span<const Sheet* const> worn,
                 bool left_arm) {
  const std::vector<float> arm = ArmShare(body);
  const std::vector<float> head = HeadShare(body);
  const std::vector<bool> is_body = IsBody(body);
  std::vector<std::vector<glm::vec2>> slabs;
  for (size_t v = 0; v < posed.positions.size(); ++v) {
    const bool wrapped_arm = left_arm && body.base.positions[v].x < 0.0f && !posed.forearm[v];
    if (is_body[v] && head[v] < 0.5f && (arm[v] < 0.3f || wrapped_arm)) {
      AddPoint(posed.positions[v], 2, slabs);
    }
  }
  const float free_side = JointPlace(body, posed, "r_shoulder").x;
  const glm::vec3 waist = JointPlace(body, posed, "vl1");
  for (const Sheet* sheet : worn) {
    for (const glm::vec3& p : sheet->positions) {
      if (p.x < (p.y > waist.y - 0.1f ? 0.8f : 1.1f) * free_side) {
        AddPoint(p, 2, slabs);
      }
    }
  }
  middle_.assign(slabs.size(), {0.0f, waist.z - 0.02f});
  for (std::vector<glm::vec2>& slab : slabs) {
    radius_.push_back(slab.empty() ? std::vector<float>(kAngles, 0.0f)
                                   : HullRadius(slab, middle_[0], kAngles));
  }
}

Outline::Outline(const FittedBody& body, const PosedBody& posed, std::string_view joint) {
  std::vector<std::vector<glm::vec2>> slabs;
  const std::vector<bool> limb = LimbOf(body, joint);
  for (size_t v = 0; v < limb.size(); ++v) {
    if (limb[v]) {
      AddPoint(posed.positions[v], 3, slabs);
    }
  }
  // Above and below the limb, and where its points are far apart, the next level above counts.
  CHECK(!slabs.empty());
  slabs.pop_back();
  middle_.resize(slabs.size());
  radius_.resize(slabs.size());
  for (size_t at = slabs.size(); at-- > 0;) {
    if (slabs[at].empty()) {
      slabs[at] = slabs[at + 1];
    }
    glm::vec2 low = slabs[at][0];
    glm::vec2 high = low;
    for (const glm::vec2& p : slabs[at]) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    middle_[at] = 0.5f * (low + high);
    radius_[at] = HullRadius(slabs[at], middle_[at], kAngles);
  }
}

// Levels above are left out, because shoulders are round.
void Outline::AddPoint(const glm::vec3& p,
                       size_t below,
                       std::vector<std::vector<glm::vec2>>& slabs) {
  const size_t level = static_cast<size_t>(std::max(0.0f, p.y) / kLevel);
  slabs.resize(std::max(slabs.size(), level + 2));
  for (size_t at = level > below ? level - below : 0; at <= level; ++at) {
    slabs[at].emplace_back(p.x, p.z);
  }
}

std::pair<size_t, float> Outline::LevelOf(float height) const {
  const float level = std::clamp(height / kLevel - 0.5f, 0.0f, float(radius_.size() - 1) - 0.01f);
  const size_t at = static_cast<size_t>(level);
  return {at, level - float(at)};
}

float Outline::Radius(float angle, float height) const {
  const auto [at, share] = LevelOf(height);
  return glm::mix(AtLevel(at, angle), AtLevel(at + 1, angle), share);
}

float Outline::Hanging(float angle, float from, float height) const {
  float radius = 0.0f;
  for (float y = from; y > height - 1e-4f; y -= kLevel) {
    radius = std::max(Radius(angle, y), radius - 0.22f * kLevel);
  }
  return radius;
}

glm::vec3 Outline::Place(float angle, float radius, float height) const {
  const auto [at, share] = LevelOf(height);
  const glm::vec2 middle = glm::mix(middle_[at], middle_[at + 1], share);
  return {middle.x + radius * std::sin(angle), height, middle.y + radius * std::cos(angle)};
}

float Outline::AtLevel(size_t level, float angle) const {
  float turn = angle / glm::two_pi<float>();
  turn = (turn - std::floor(turn)) * kAngles;
  const int k = static_cast<int>(turn) % kAngles;
  const std::vector<float>& radius = radius_[level];
  return glm::mix(radius[k], radius[(k + 1) % kAngles], turn - std::floor(turn));
}

}  // namespace lararium::import
