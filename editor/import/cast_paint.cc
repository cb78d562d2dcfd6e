#include "editor/import/cast_paint.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace lararium::import {
namespace {

constexpr int kMaxSide = 8192;

Result<cv::Mat> Decode(const std::string& name, std::span<const std::byte> encoded, int flags) {
  cv::Mat image;
  if (!encoded.empty() && encoded.size() <= human::Texture::kMaxEncodedBytes) {
    const cv::Mat bytes(1, static_cast<int>(encoded.size()), CV_8U,
                        const_cast<std::byte*>(encoded.data()));
    try {
      image = cv::imdecode(bytes, flags);
    } catch (const cv::Exception&) {
      image.release();
    }
  }
  if (image.empty() || image.depth() != CV_8U || image.cols > kMaxSide || image.rows > kMaxSide) {
    return Status::Error(name, "is no picture that can be read",
                         "PNG or JPEG of 8 bits, at most 8192 pixels wide and high");
  }
  return image;
}

cv::Mat Reduced(const cv::Mat& image, int max_size) {
  const int size = std::max(image.cols, image.rows);
  if (size <= max_size) {
    return image;
  }
  const double scale = static_cast<double>(max_size) / size;
  cv::Mat smaller;
  cv::resize(image, smaller, {}, scale, scale, cv::INTER_AREA);
  return smaller;
}

Result<human::Texture> Encode(const std::string& name,
                              const cv::Mat& image,
                              const std::string& ending,
                              const std::vector<int>& options) {
  std::vector<uchar> bytes;
  try {
    cv::imencode(ending, image, bytes, options);
  } catch (const cv::Exception& error) {
    return Status::Error(name, std::string("cannot be encoded: ") + error.what());
  }
  human::Texture texture;
  texture.name = name;
  texture.encoded.resize(bytes.size());
  std::transform(bytes.begin(), bytes.end(), texture.encoded.begin(),
                 [](uchar b) { return static_cast<std::byte>(b); });
  return texture;
}

Result<human::Texture> EncodePng(const std::string& name, const cv::Mat& image) {
  return Encode(name, image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 9});
}

Result<human::Texture> EncodeJpeg(const std::string& name, const cv::Mat& image) {
  return Encode(name, image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, 90});
}

// Brings the mean of what is covered to the colour, keeping light and dark.
void Dye(cv::Mat& bgra, const glm::vec3& colour) {
  double sum = 0.0;
  double weight = 0.0;
  const auto grey = [](const cv::Vec4b& p) { return 0.114 * p[0] + 0.587 * p[1] + 0.299 * p[2]; };
  for (int y = 0; y < bgra.rows; ++y) {
    for (const cv::Vec4b* p = bgra.ptr<cv::Vec4b>(y); p != bgra.ptr<cv::Vec4b>(y) + bgra.cols;
         ++p) {
      sum += grey(*p) * (*p)[3];
      weight += (*p)[3];
    }
  }
  const double mean = weight > 0.0 ? std::max(sum / weight, 1.0) : 128.0;
  for (int y = 0; y < bgra.rows; ++y) {
    for (int x = 0; x < bgra.cols; ++x) {
      cv::Vec4b& p = bgra.at<cv::Vec4b>(y, x);
      // Pictures of black hair hold less contrast than the eye expects of brown hair.
      const double shade = std::clamp(std::sqrt(std::max(grey(p), 1.0) / mean), 0.45, 1.8);
      for (int channel = 0; channel < 3; ++channel) {
        p[channel] = cv::saturate_cast<uchar>(shade * colour[2 - channel] * 255.0);
      }
    }
  }
}

}  // namespace

Result<human::Texture> DyedTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const std::optional<glm::vec3>& colour,
                                   int max_size) {
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image, Decode(name, encoded, cv::IMREAD_UNCHANGED));
  if (image.channels() != 4) {
    cv::cvtColor(image, image, image.channels() == 3 ? cv::COLOR_BGR2BGRA : cv::COLOR_GRAY2BGRA);
  }
  image = Reduced(image, max_size);
  if (colour) {
    Dye(image, *colour);
  }
  return EncodePng(name, image);
}

Result<human::Texture> OpaqueTexture(const std::string& name,
                                     std::span<const std::byte> encoded,
                                     int max_size) {
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat image, Decode(name, encoded, cv::IMREAD_COLOR));
  return EncodeJpeg(name, Reduced(image, max_size));
}

}  // namespace lararium::import
