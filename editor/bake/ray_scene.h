#pragma once

// Triangles that rays are cast at (Embree).

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "shared/core/status.h"

namespace lararium::bake {

// The texel at texture coordinates that wrap, (0, 0) being the image's top left.
cv::Point WrappedTexel(const glm::vec2& uv, const cv::Size& size);

// Borrowed only while the scene is made, except for the coverage, which is shared.
struct RayMesh {
  std::span<const glm::vec3> positions;
  std::span<const uint32_t> indices;  // three for each triangle
  // Where coverage (CV_8UC1, at texture coordinates that wrap) is below a half, rays
  // pass. Empty: solid.
  std::span<const glm::vec2> uvs = {};
  cv::Mat coverage = {};
};

struct RayHit {
  float distance = 0.0f;
  uint32_t mesh = 0;
  uint32_t triangle = 0;
  // Weights of the triangle's corners.
  glm::vec3 barycentric = glm::vec3(0.0f);
  glm::vec3 face = glm::vec3(0.0f);  // unit normal of the triangle, counter-clockwise outside
};

// Immutable; rays may be cast from many threads.
class RayScene {
 public:
  // Fails where there is nothing to hit or memory runs out. Indices must be valid.
  static Result<RayScene> Create(std::span<const RayMesh> meshes);
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  // The nearest hit farther than near. direction: unit.
  std::optional<RayHit> Trace(const glm::vec3& origin,
                              const glm::vec3& direction,
                              float near = 1e-4f) const;
  // Whether anything is hit at all.
  bool Blocked(const glm::vec3& origin, const glm::vec3& direction, float near = 1e-4f) const;

 private:
  struct State;
  explicit RayScene(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::bake
