#include "editor/app/png_file.h"

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/file.h"

namespace lararium::app {

namespace {
constexpr size_t kMaxBytes = size_t{1} << 20;
}

std::optional<cv::Mat> LoadPng(const std::filesystem::path& file) {
  const Result<std::string> bytes = ReadText(file, kMaxBytes);
  if (!bytes.ok()) {
    return std::nullopt;
  }
  try {
    cv::Mat bgr =
        cv::imdecode(std::vector<uint8_t>(bytes->begin(), bytes->end()), cv::IMREAD_COLOR);
    return bgr.empty() ? std::nullopt : std::optional(std::move(bgr));
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

Status SavePng(const std::filesystem::path& file, const cv::Mat& bgr) {
  std::vector<uint8_t> bytes;
  try {
    if (cv::imencode(".png", bgr, bytes)) {
      return WriteFileAtomically(file, std::as_bytes(std::span(bytes)));
    }
  } catch (const cv::Exception&) {
    // answered below
  }
  return Status::Error(file.string(), "the picture cannot be encoded");
}

}  // namespace lararium::app
