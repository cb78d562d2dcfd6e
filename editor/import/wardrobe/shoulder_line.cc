#include "editor/import/wardrobe/shoulder_line.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lararium::import {
namespace {

constexpr float kShoulderBin = 0.015f;  // Metres of breadth for each point of the line.

}  // namespace

ShoulderLine::ShoulderLine(const FittedBody& body, const PosedBody& posed, float above) {
  const std::vector<float> head = HeadShare(body);
  const std::vector<bool> is_body = IsBody(body);
  const glm::vec3 wrist = JointPlace(body, posed, "r_wrist");
  depth_ = JointPlace(body, posed, "r_shoulder").z;
  const size_t bins = static_cast<size_t>(wrist.x / kShoulderBin);
  std::vector<float> top(bins + 1, 0.0f);
  for (size_t v = 0; v < posed.positions.size(); ++v) {
    const glm::vec3& p = posed.positions[v];
    const size_t bin = static_cast<size_t>(std::abs(p.x) / kShoulderBin);
    if (is_body[v] && head[v] < 0.5f && bin <= bins) {
      top[bin] = std::max(top[bin], p.y);
    }
  }
  float highest = *std::max_element(top.begin(), top.end());
  for (float& y : top) {
    highest = y = std::min(highest, y > 0.0f ? y : highest);
  }
  float length = 0.0f;
  for (size_t b = 0; b <= bins; ++b) {
    places_.emplace_back(kShoulderBin * static_cast<float>(b), top[b] + above);
    length += b > 0 ? glm::distance(places_[b], places_[b - 1]) : 0.0f;
    lengths_.push_back(length);
  }
}

glm::vec2 ShoulderLine::At(float s) const {
  const float length = std::min(std::abs(s), lengths_.back());
  const size_t next = std::max<size_t>(
      1, size_t(std::lower_bound(lengths_.begin(), lengths_.end(), length) - lengths_.begin()));
  const float f = (length - lengths_[next - 1]) / (lengths_[next] - lengths_[next - 1]);
  const glm::vec2 p = glm::mix(places_[next - 1], places_[next], f);
  const float beyond = std::abs(s) - length;
  return {std::copysign(p.x + 0.7f * beyond, s), p.y - 0.7f * beyond};
}

float ShoulderLine::LengthTo(float x) const {
  const size_t bin = std::min(places_.size() - 1, static_cast<size_t>(x / kShoulderBin));
  return lengths_[bin];
}

}  // namespace lararium::import
