#pragma once

// Images of the cast: tints and weathers skins, paints stubble and the shade of hair, dyes hair
// and brows, and encodes the results small.

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

// What to paint on a skin. Masks have a value 0..1 for each vertex of the drawn skin.
struct SkinPaint {
  std::span<const glm::vec2> uvs;  // Texture coordinates of the vertices; (0, 0) is the top left.
  std::span<const uint32_t> indices;  // Triangles of the skin.
  std::vector<float> scalp;           // Hair grows or rests here.
  std::vector<float> beard;           // A beard would grow here.
  std::vector<float> lids;            // Shade and make-up in the image are removed here.
  std::vector<float> cheeks;          // The skin has the true colour of the lids here.
  std::vector<float> freckles;        // Density of freckles.
  std::vector<float> sunburn;         // Redness.
  glm::vec3 scalp_colour{0.1f};       // sRGB-encoded, like the following.
  glm::vec3 beard_colour{0.1f};
  float stubble = 0.0f;  // 0..1
  std::optional<glm::vec3> tint;
  float weathering = 0.0f;  // 0..1
  uint64_t seed = 1;
};

// A skin of the library, shifted to the mean colour `tint` and painted, with added fine detail
// (pores, mottling) that its resolution lacks. Gives a JPEG.
Result<human::Texture> SkinTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const SkinPaint& paint);

// Dyes an image with alpha to one colour (sRGB-encoded, 0..1) and keeps light and dark; without
// a colour it keeps its own. PNG in, PNG out.
Result<human::Texture> DyedTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const std::optional<glm::vec3>& colour,
                                   int max_size);

// Dyes the irises in an image of eyeballs; transparent parts (the cornea) stay transparent.
Result<human::Texture> EyeTexture(const std::string& name,
                                  std::span<const std::byte> encoded,
                                  const std::optional<glm::vec3>& colour,
                                  int max_size);

// The alpha channel of an image.
struct Coverage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> alpha;  // Row by row from the top, 0..255; empty if everything is opaque.

  float At(const glm::vec2& uv) const;  // 0..1 at the nearest pixel; coordinates wrap.
};
Result<Coverage> CoverageOf(const std::string& name, std::span<const std::byte> encoded);

// An image without its alpha, as JPEG.
Result<human::Texture> OpaqueTexture(const std::string& name,
                                     std::span<const std::byte> encoded,
                                     int max_size);

}  // namespace lararium::import
