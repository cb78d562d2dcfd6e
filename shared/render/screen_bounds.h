#pragma once

// Which pixels something may cover: drawing is limited to them, which saves most
// of the bandwidth of several samples. Private to render.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace lararium::render {

struct ImageSize {
  int width = 0;
  int height = 0;

  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

// Columns [left, right) and rows [bottom, top) in OpenGL's window coordinates.
struct PixelBounds {
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  int width() const { return right - left; }
  int height() const { return top - bottom; }
  bool empty() const { return width() <= 0 || height() <= 0; }
};

// As shaders take them.
inline glm::vec4 Corners(const PixelBounds& bounds) {
  return glm::vec4(bounds.left, bounds.bottom, bounds.right, bounds.top);
}

// Bounds that hold both.
PixelBounds Union(const PixelBounds& a, const PixelBounds& b);

// An axis-aligned box; holds nothing at first.
struct Box {
  glm::vec3 low = glm::vec3(std::numeric_limits<float>::max());
  glm::vec3 high = glm::vec3(std::numeric_limits<float>::lowest());

  void Extend(const glm::vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  bool empty() const { return low.x > high.x; }
};

// The box of a box that an affine transform moved.
Box Transformed(const Box& box, const glm::mat4& target_from_box);
Box Intersection(const Box& a, const Box& b);
// A box that holds both.
Box Union(const Box& a, const Box& b);

// Grows over what it is given; never too small.
class ScreenBounds {
 public:
  void Extend(const Box& box, const glm::mat4& clip_from_box);
  void Extend(const ScreenBounds& other);
  PixelBounds Pixels(int width, int height) const;

 private:
  glm::vec2 low_ = glm::vec2(std::numeric_limits<float>::max());  // of -1..1
  glm::vec2 high_ = glm::vec2(std::numeric_limits<float>::lowest());
  bool reaches_behind_viewer_ = false;  // then it may cover anything
};

}  // namespace lararium::render
