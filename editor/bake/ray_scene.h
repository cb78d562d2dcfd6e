#pragma once

// Casts rays at triangles (Embree).

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "shared/core/status.h"

namespace lararium::bake {

// The texel at texture coordinates that wrap; (0, 0) is the top left of the image.
cv::Point WrappedTexel(const glm::vec2& uv, const cv::Size& size);

// The spans are used only while the scene is created; the coverage is shared.
struct RayMesh {
  std::span<const glm::vec3> positions;
  std::span<const uint32_t> indices;  // Three for each triangle.
  // Rays pass where the coverage (CV_8UC1, at texture coordinates that wrap) is below a half.
  // Empty if the mesh is solid.
  std::span<const glm::vec2> uvs = {};
  cv::Mat coverage = {};
};

struct RayHit {
  float distance = 0.0f;
  uint32_t mesh = 0;
  uint32_t triangle = 0;
  // Weights of the triangle's corners.
  glm::vec3 barycentric = glm::vec3(0.0f);
  // Unit normal of the triangle; corners are counter-clockwise from outside.
  glm::vec3 face = glm::vec3(0.0f);
};

// Immutable; rays may be cast from many threads.
class RayScene {
 public:
  // Fails if there are no triangles or memory runs out. Indices must be valid.
  static Result<RayScene> Create(std::span<const RayMesh> meshes);
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  // The nearest hit farther than `near`. `direction` has unit length.
  std::optional<RayHit> Trace(const glm::vec3& origin,
                              const glm::vec3& direction,
                              float near = 1e-4f) const;
  // Says whether a ray hits anything.
  bool Blocked(const glm::vec3& origin, const glm::vec3& direction, float near = 1e-4f) const;

 private:
  struct State;
  explicit RayScene(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::bake
