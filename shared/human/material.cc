#include "shared/human/material.h"

namespace lararium::human {
namespace {

bool IsShare(float value) { return value >= 0.0f && value <= 1.0f; }

bool StartsWith(const std::vector<std::byte>& bytes, std::initializer_list<int> magic) {
  if (bytes.size() < magic.size()) {
    return false;
  }
  size_t i = 0;
  for (const int value : magic) {
    if (bytes[i++] != static_cast<std::byte>(value)) {
      return false;
    }
  }
  return true;
}

bool IsTextureOrNone(int16_t texture, size_t texture_count) {
  return texture == Material::kNone || (texture >= 0 && size_t(texture) < texture_count);
}

}  // namespace

Status Texture::Validate(const std::string& where) const {
  const std::string at = where + ": texture '" + name + "'";
  if (encoded.size() > kMaxEncodedBytes) {
    return Status::Error(at, "is too large");
  }
  if (!StartsWith(encoded, {0x89, 'P', 'N', 'G'}) && !StartsWith(encoded, {0xff, 0xd8, 0xff})) {
    return Status::Error(at, "is neither PNG nor JPEG");
  }
  return Status();
}

Status Material::Validate(size_t texture_count, const std::string& where) const {
  const std::string at = where + ": material '" + name + "'";
  if (static_cast<uint8_t>(surface) >= kSurfaceCount) {
    return Status::Error(at, "its kind of surface is unknown");
  }
  if (!IsTextureOrNone(colour_texture, texture_count) ||
      !IsTextureOrNone(normal_texture, texture_count)) {
    return Status::Error(at, "names a texture that does not exist");
  }
  if (!IsShare(colour.x) || !IsShare(colour.y) || !IsShare(colour.z) || !IsShare(roughness) ||
      !IsShare(alpha_cutoff)) {
    return Status::Error(at, "a colour, roughness or cutoff is outside 0..1");
  }
  return Status();
}

}  // namespace lararium::human
