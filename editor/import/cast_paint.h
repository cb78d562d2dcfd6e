#pragma once

// Pictures of the cast: skins tinted, weathered and given stubble and the shade of
// hair; hair and brows dyed; all encoded small.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/material.h"

namespace lararium::import {

// What a skin is painted with. Masks are of the drawn skin's vertices, 0..1.
struct SkinPaint {
  std::span<const glm::vec2> uvs;     // of the skin's vertices, (0, 0) the top left
  std::span<const uint32_t> indices;  // its triangles
  std::vector<float> scalp;           // where hair grows or lies
  std::vector<float> beard;           // where a beard would grow
  std::vector<float> lids;            // how far pictured shade and make-up give way
  std::vector<float> cheeks;          // where the skin has the lids' true colour
  std::vector<float> freckles;        // how many
  std::vector<float> sunburn;         // how red
  glm::vec3 scalp_colour{0.1f};       // sRGB-encoded, as are the next
  glm::vec3 beard_colour{0.1f};
  float stubble = 0.0f;  // 0..1
  std::optional<glm::vec3> tint;
  float weathering = 0.0f;  // 0..1
  uint64_t seed = 1;
};

// A skin as the library has it, brought to the tint's mean colour and painted, with
// the small irregularities (pores, mottling) that its resolution lacks. JPEG.
Result<human::Texture> SkinTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const SkinPaint& paint);

// A picture with alpha in which everything takes one colour (sRGB-encoded, 0..1) and
// keeps its light and dark; none: as it is. PNG in, PNG out.
Result<human::Texture> DyedTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const std::optional<glm::vec3>& colour,
                                   int max_size);

// A picture of eyeballs whose irises take a colour; what is transparent (the cornea)
// stays so.
Result<human::Texture> EyeTexture(const std::string& name,
                                  std::span<const std::byte> encoded,
                                  const std::optional<glm::vec3>& colour,
                                  int max_size);

// How much a picture covers.
struct Coverage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> alpha;  // row by row from the top, 0..255; empty: all is covered

  float At(const glm::vec2& uv) const;  // 0..1, of the nearest pixel; repeats
};
Result<Coverage> CoverageOf(const std::string& name, std::span<const std::byte> encoded);

// A picture without its alpha, as a JPEG.
Result<human::Texture> OpaqueTexture(const std::string& name,
                                     std::span<const std::byte> encoded,
                                     int max_size);

}  // namespace lararium::import
