#include "shared/render/passes/screen_bounds.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

namespace lararium::render {

PixelBounds Union(const PixelBounds& a, const PixelBounds& b) {
  if (a.empty() || b.empty()) {
    return a.empty() ? b : a;
  }
  return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right),
          std::max(a.top, b.top)};
}

Box Transformed(const Box& box, const glm::mat4& target_from_box) {
  Box moved;
  if (box.empty()) {
    return moved;
  }
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec4 point((corner & 1) != 0 ? box.high.x : box.low.x,
                          (corner & 2) != 0 ? box.high.y : box.low.y,
                          (corner & 4) != 0 ? box.high.z : box.low.z, 1.0f);
    moved.Extend(glm::vec3(target_from_box * point));
  }
  return moved;
}

Box Intersection(const Box& a, const Box& b) {
  const Box both = {glm::max(a.low, b.low), glm::min(a.high, b.high)};
  const bool meet = glm::all(glm::lessThanEqual(both.low, both.high));
  return meet ? both : Box();
}

Box Union(const Box& a, const Box& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

void ScreenBounds::Extend(const Box& box, const glm::mat4& clip_from_box) {
  if (box.empty()) {
    return;
  }
  constexpr float kNearest = 1e-4f;
  std::array<glm::vec4, 8> corners;  // clip space
  float nearest = std::numeric_limits<float>::max();
  float farthest = std::numeric_limits<float>::lowest();
  for (size_t corner = 0; corner < corners.size(); ++corner) {
    corners[corner] = clip_from_box * glm::vec4((corner & 1) != 0 ? box.high.x : box.low.x,
                                                (corner & 2) != 0 ? box.high.y : box.low.y,
                                                (corner & 4) != 0 ? box.high.z : box.low.z, 1.0f);
    nearest = std::min(nearest, corners[corner].w);
    farthest = std::max(farthest, corners[corner].w);
  }
  if (farthest <= 0.0f) {
    return;  // the box lies behind the viewer
  }
  if (!(nearest > kNearest)) {
    reaches_behind_viewer_ = true;
    return;
  }
  for (const glm::vec4& clip : corners) {
    const glm::vec2 point = glm::vec2(clip) / clip.w;
    low_ = glm::min(low_, point);
    high_ = glm::max(high_, point);
  }
}

void ScreenBounds::Extend(const ScreenBounds& other) {
  low_ = glm::min(low_, other.low_);
  high_ = glm::max(high_, other.high_);
  reaches_behind_viewer_ |= other.reaches_behind_viewer_;
}

PixelBounds ScreenBounds::Pixels(int width, int height) const {
  if (reaches_behind_viewer_) {
    return {0, 0, width, height};
  }
  if (!(low_.x <= high_.x && low_.y <= high_.y)) {
    return {};
  }
  constexpr float kMargin = 1.0f;  // pixels
  const auto pixel = [](float position, int size, float margin) {
    const float at = (0.5f * position + 0.5f) * static_cast<float>(size) + margin;
    return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(size)));
  };
  return {pixel(low_.x, width, -kMargin), pixel(low_.y, height, -kMargin),
          pixel(high_.x, width, 1.0f + kMargin), pixel(high_.y, height, 1.0f + kMargin)};
}

}  // namespace lararium::render
