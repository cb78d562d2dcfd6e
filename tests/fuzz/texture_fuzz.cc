// libFuzzer harness: any bytes as a texture are decoded completely, at every size, or refused.

#include <span>

#include "shared/core/check.h"
#include "shared/render/gl/texture_image.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using lararium::render::TextureUse;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto whole = lararium::render::DecodeForUse(bytes, TextureUse::kColour, 0, "fuzz: texture");
  const auto small = lararium::render::DecodeForUse(bytes, TextureUse::kNormal, 3, "fuzz: texture");
  CHECK(whole.ok() == small.ok());
  if (whole.ok()) {
    CHECK(whole->type() == CV_8UC4 && small->type() == CV_8UC4);
    CHECK(whole->cols <= lararium::render::kMaxTextureSide);
    CHECK(small->cols <= whole->cols && small->rows <= whole->rows && !small->empty());
  }
  return 0;
}
