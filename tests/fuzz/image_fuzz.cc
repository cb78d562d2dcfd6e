// libFuzzer harness: any bytes as a picture are decoded completely or refused.

#include <span>

#include "shared/core/check.h"
#include "shared/image/decode.h"
#include "shared/image/picture_notes.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using lararium::image::Channels;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto grey = lararium::image::DecodeImage(bytes, Channels::kGrey, "fuzz: image");
  const auto bgr = lararium::image::DecodeImage(bytes, Channels::kBgr, "fuzz: image");
  const auto small = lararium::image::DecodeImage(bytes, Channels::kBgr, "fuzz: image", 2);
  for (const std::string& note : lararium::image::PictureNotes(bytes)) {
    CHECK(!note.empty());
  }
  CHECK(grey.ok() == bgr.ok() && small.ok() == bgr.ok());
  if (bgr.ok()) {
    CHECK(small->cols <= bgr->cols && small->rows <= bgr->rows && !small->empty());
    CHECK(grey->size() == bgr->size() && grey->type() == CV_8UC1 && bgr->type() == CV_8UC3);
  }
  return 0;
}
