#include "editor/import/model/model_textures.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string_view>

#include "editor/import/model/model_gltf.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"
#include "shared/image/image_header.h"

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

Result<std::vector<std::byte>> Encode(cv::Mat image) {
  const int longer = std::max(image.cols, image.rows);
  if (longer > kMaxTextureSide) {
    const double scale = static_cast<double>(kMaxTextureSide) / longer;
    const cv::Size size(std::max(1, cvRound(image.cols * scale)),
                        std::max(1, cvRound(image.rows * scale)));
    cv::resize(image, image, size, 0.0, 0.0, cv::INTER_AREA);
  }
  if (HasHoles(image)) {
    return image::EncodePng(image);
  }
  cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
  return image::EncodeJpeg(image, kJpegQuality);
}

// Decodes percent escapes such as %20 in file names.
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

std::filesystem::path FindReferenced(const std::filesystem::path& model, std::string_view uri) {
  if (uri.size() > 4096) {
    return {};
  }
  const std::filesystem::path folder = model.parent_path();
  std::vector<std::filesystem::path> candidates;
  for (const std::string& path : {Unescaped(uri), std::string(uri)}) {
    if (IsSafeRelativePath(path)) {
      candidates.push_back(folder / std::filesystem::path(path).lexically_normal());
    }
    const std::string bare = path.substr(path.rfind('/') + 1);
    if (IsSafeRelativePath(bare)) {
      candidates.push_back(folder / bare);
      candidates.push_back(folder / "textures" / bare);
      candidates.push_back(folder / (model.stem().string() + ".fbm") / bare);
    }
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
                                      const std::string& where) {
  const std::string at = where + ": texture '" + name + "'";
  const std::optional<image::ImageHeader> size = image::ReadImageHeader(encoded);
  if (!size) {
    const std::string_view head(reinterpret_cast<const char*>(encoded.data()),
                                std::min<size_t>(encoded.size(), 4));
    return Status::Error(at,
                         head == "\xABKTX"
                             ? "is a KTX file for graphics cards, which is not read"
                             : "is neither PNG, JPEG, WebP, AVIF, TIFF, BMP, PSD, DDS nor TGA, or "
                               "is damaged",
                         "convert it to PNG");
  }
  if (size->width == 0 || size->height == 0 || size->width > 65'535 || size->height > 65'535 ||
      uint64_t{size->width} * size->height > kMaxPixels) {
    return Status::Error(
        at, "has " + std::to_string(size->width) + " x " + std::to_string(size->height) + " pixels",
        "scale it down");
  }
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image, image::DecodeImage(encoded, image::Channels::kBgra, at));
  human::Texture texture{name, {}};
  LARARIUM_ASSIGN_OR_RETURN(texture.encoded, Encode(std::move(image)));
  LARARIUM_RETURN_IF_ERROR(texture.Validate(where));
  return texture;
}

}  // namespace lararium::import
