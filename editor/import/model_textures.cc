#include "editor/import/model_textures.h"

#include <algorithm>
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "editor/import/model_gltf.h"
#include "shared/core/image_header.h"

namespace lararium::import {
namespace {

constexpr uint64_t kMaxPixels = uint64_t{1} << 26;
constexpr int kJpegQuality = 92;

bool HasHoles(const cv::Mat& image) {
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  double least = 0.0;
  cv::minMaxIdx(alpha, &least);
  return least < 255.0;
}

std::vector<std::byte> Encode(cv::Mat image) {
  if (image.depth() == CV_16U) {
    image.convertTo(image, CV_8U, 1.0 / 257.0);
  }
  const int longer = std::max(image.cols, image.rows);
  if (longer > kMaxTextureSide) {
    const double scale = static_cast<double>(kMaxTextureSide) / longer;
    const cv::Size size(std::max(1, cvRound(image.cols * scale)),
                        std::max(1, cvRound(image.rows * scale)));
    cv::resize(image, image, size, 0.0, 0.0, cv::INTER_AREA);
  }
  if (image.channels() == 4 && !HasHoles(image)) {
    cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
  }
  std::vector<uchar> encoded;
  if (image.channels() == 4) {
    cv::imencode(".png", image, encoded);
  } else {
    cv::imencode(".jpg", image, encoded, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  }
  const auto* begin = reinterpret_cast<const std::byte*>(encoded.data());
  return {begin, begin + encoded.size()};
}

// File names may come with %20 for a space.
std::string Unescaped(std::string_view uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0;
    text += escaped ? static_cast<char>(std::stoi(std::string(uri.substr(i + 1, 2)), nullptr, 16))
                    : uri[i];
    i += escaped ? 2 : 0;
  }
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

}  // namespace

std::filesystem::path FindTexture(const std::filesystem::path& model, std::string_view uri) {
  if (uri.size() > 4096) {
    return {};
  }
  const std::string path = Unescaped(uri);
  const std::filesystem::path folder = model.parent_path();
  const std::string bare =
      path.substr(path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
  std::vector<std::filesystem::path> candidates;
  if (IsSafeRelativePath(path)) {
    candidates.push_back(folder / path);
  }
  if (IsSafeRelativePath(bare)) {
    candidates.push_back(folder / bare);
    candidates.push_back(folder / "textures" / bare);
    candidates.push_back(folder / (model.stem().string() + ".fbm") / bare);
  }
  for (const std::filesystem::path& candidate : candidates) {
    std::error_code error;
    if (std::filesystem::is_regular_file(candidate, error)) {
      return candidate;
    }
  }
  return {};
}

Result<human::Texture> PrepareTexture(const std::vector<std::byte>& encoded,
                                      const std::string& name,
                                      const std::string& place) {
  const std::string at = place + ": texture '" + name + "'";
  const std::optional<ImageHeader> size = ReadImageHeader(encoded);
  if (!size) {
    return Status::Error(at, "is neither PNG, JPEG nor BMP, or is damaged", "convert it to PNG");
  }
  if (size->width == 0 || size->height == 0 || size->width > 65'535 || size->height > 65'535 ||
      uint64_t{size->width} * size->height > kMaxPixels) {
    return Status::Error(
        at, "has " + std::to_string(size->width) + " x " + std::to_string(size->height) + " pixels",
        "scale it down");
  }
  try {
    const cv::Mat bytes(1, static_cast<int>(encoded.size()), CV_8U,
                        const_cast<std::byte*>(encoded.data()));
    cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (!image.empty() && image.channels() < 3) {
      image = cv::imdecode(bytes, cv::IMREAD_COLOR);  // grey, with or without alpha
    }
    if (image.empty() || (image.depth() != CV_8U && image.depth() != CV_16U)) {
      return Status::Error(at, "cannot be decoded", "save it again as PNG");
    }
    human::Texture texture{name, Encode(image)};
    LARARIUM_RETURN_IF_ERROR(texture.Validate(place));
    return texture;
  } catch (const std::exception& exception) {
    return Status::Error(at, std::string("cannot be decoded: ") + exception.what());
  }
}

}  // namespace lararium::import
