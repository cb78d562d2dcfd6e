// libFuzzer harness: any bytes as a film give frames of one size, or an error.

#include <unistd.h>

#include <filesystem>
#include <span>

#include "shared/capture/frame_source.h"
#include "shared/core/check.h"
#include "shared/core/file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("film_fuzz." + std::to_string(getpid()));
  CHECK(lararium::WriteFileAtomically(file, std::as_bytes(std::span(data, size))).ok());
  const auto source = lararium::capture::OpenVideo(file);
  std::filesystem::remove(file);
  if (!source.ok()) {
    return 0;
  }
  constexpr int kFrames = 4;
  for (int i = 0; i < kFrames; ++i) {
    const auto frame = (*source)->Next();
    if (!frame.ok() || !frame->has_value()) {
      break;
    }
    CHECK((*frame)->bgr.cols == (*source)->width() && (*frame)->bgr.rows == (*source)->height());
    CHECK((*frame)->grey.size() == (*frame)->bgr.size());
  }
  return 0;
}
