// libFuzzer harness: looking for EXIF data in any bytes terminates, and a result is a possible
// exposure and focal length.

#include <cmath>
#include <span>

#include "shared/capture/exif.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  if (const auto exposure = lararium::capture::FindExposure(bytes)) {
    CHECK(std::isfinite(*exposure) && *exposure > 0.0);
  }
  if (const auto focal = lararium::capture::FindFocalLengthIn35mmFilm(bytes)) {
    CHECK(*focal > 0);
  }
  const auto orientation = lararium::capture::FindOrientation(bytes);
  CHECK(orientation.SizeOf({3, 2}).area() == 6);
  return 0;
}
