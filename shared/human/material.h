#pragma once

// What the surface of a person looks like.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::human {

// An image as its file holds it: PNG or JPEG. Whoever draws decodes it. Colours are
// sRGB-encoded, alpha is coverage; normal maps are linear, tangent space, green up.
struct Texture {
  static constexpr size_t kMaxEncodedBytes = size_t{64} << 20;

  std::string name;
  std::vector<std::byte> encoded;

  Status Validate(const std::string& place) const;

  friend bool operator==(const Texture&, const Texture&) = default;
};

// Which model of reflection fits.
// Metals reflect in their own colour and nothing else.
enum class Surface : uint8_t { kPlain, kSkin, kHair, kCloth, kEye, kMetal };
inline constexpr uint8_t kSurfaceCount = 6;

struct Material {
  static constexpr int16_t kNone = -1;

  std::string name;
  Surface surface = Surface::kPlain;
  int16_t colour_texture = kNone;      // index into Human::textures
  int16_t normal_texture = kNone;      // likewise
  glm::vec3 colour = glm::vec3(1.0f);  // linear, 0..1; multiplies texture and vertex albedo
  float roughness = 0.8f;              // 0..1
  // What is less covered than this is not there; 0: opaque.
  float alpha_cutoff = 0.0f;
  bool two_sided = false;

  Status Validate(size_t texture_count, const std::string& place) const;
};

}  // namespace lararium::human
