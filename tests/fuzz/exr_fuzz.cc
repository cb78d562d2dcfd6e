// libFuzzer harness: any bytes as an OpenEXR picture give a complete picture or an error.

#include <unistd.h>

#include <filesystem>
#include <span>

#include "editor/bake/exr_image.h"
#include "shared/core/check.h"
#include "shared/core/file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("exr_fuzz." + std::to_string(getpid()));
  CHECK(lararium::WriteFileAtomically(file, std::as_bytes(std::span(data, size))).ok());
  const auto image = lararium::bake::ReadExr(file, [](int64_t width, int64_t height) {
    constexpr int64_t kLargest = 256;
    return width > 0 && height > 0 && width <= kLargest && height <= kLargest
               ? lararium::Status()
               : lararium::Status::Error("fuzz: exr", "is too large");
  });
  std::filesystem::remove(file);
  if (image.ok()) {
    CHECK(image->pixels.size() ==
          static_cast<size_t>(image->width) * static_cast<size_t>(image->height));
  }
  return 0;
}
