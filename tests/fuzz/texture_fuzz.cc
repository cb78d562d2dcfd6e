#include <span>

#include "shared/core/check.h"
#include "shared/render/texture_image.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  auto image =
      lararium::render::DecodeTexture(std::as_bytes(std::span(data, size)), "fuzz: texture");
  if (image.ok()) {
    CHECK(image->type() == CV_8UC4);
    CHECK(image->cols <= lararium::render::kMaxTextureSide);
    lararium::render::PremultiplySrgb(*image);
  }
  return 0;
}
