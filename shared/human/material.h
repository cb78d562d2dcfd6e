#pragma once

// Textures and materials of a person's surface.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::human {

// An encoded image (PNG or JPEG), which the renderer decodes. Colours are sRGB-encoded, and alpha
// is coverage; normal maps are linear, in tangent space, with green up.
struct Texture {
  static constexpr size_t kMaxEncodedBytes = size_t{64} << 20;

  std::string name;
  std::vector<std::byte> encoded;

  Status Validate(const std::string& where) const;

  friend bool operator==(const Texture&, const Texture&) = default;
};

// The reflection model. Metals have only a coloured specular reflection.
enum class Surface : uint8_t { kPlain, kSkin, kHair, kCloth, kEye, kMetal };
inline constexpr uint8_t kSurfaceCount = 6;

struct Material {
  static constexpr int16_t kNone = -1;

  std::string name;
  Surface surface = Surface::kPlain;
  int16_t colour_texture = kNone;      // index into Human::textures
  int16_t normal_texture = kNone;      // Index into Human::textures.
  glm::vec3 colour = glm::vec3(1.0f);  // Linear, 0..1; multiplies texture and vertex albedo.
  float roughness = 0.8f;              // 0..1
  // Fragments with a lower alpha are discarded; 0: opaque.
  float alpha_cutoff = 0.0f;
  bool two_sided = false;

  Status Validate(size_t texture_count, const std::string& where) const;
};

}  // namespace lararium::human
