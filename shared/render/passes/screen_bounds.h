#pragma once

// Pixels that an object may cover. Drawing is limited to them, which saves most of the bandwidth
// of multisampling. Boxes also bound what blocks light (shared/show, editor/bake).

#include <glm/common.hpp>
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

// The bounds as shaders take them: left, bottom, right, top.
inline glm::vec4 Corners(const PixelBounds& bounds) {
  return glm::vec4(bounds.left, bounds.bottom, bounds.right, bounds.top);
}

// The smallest bounds that contain both.
PixelBounds Union(const PixelBounds& a, const PixelBounds& b);

// An axis-aligned box; empty by default.
struct Box {
  glm::vec3 low = glm::vec3(std::numeric_limits<float>::max());
  glm::vec3 high = glm::vec3(std::numeric_limits<float>::lowest());

  void Extend(const glm::vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  bool empty() const { return low.x > high.x; }
};

// The bounding box of a box after an affine transform.
Box Transformed(const Box& box, const glm::mat4& target_from_box);
Box Intersection(const Box& a, const Box& b);
// The smallest box that contains both.
Box Union(const Box& a, const Box& b);

// Bounds on the screen that grow with each Extend. They may be too large, but never too small.
class ScreenBounds {
 public:
  void Extend(const Box& box, const glm::mat4& clip_from_box);
  void Extend(const ScreenBounds& other);
  PixelBounds Pixels(int width, int height) const;

 private:
  // Normalised device coordinates, -1..1 within the picture.
  glm::vec2 low_ = glm::vec2(std::numeric_limits<float>::max());
  glm::vec2 high_ = glm::vec2(std::numeric_limits<float>::lowest());
  bool reaches_behind_viewer_ = false;  // if true, any pixel may be covered
};

}  // namespace lararium::render
