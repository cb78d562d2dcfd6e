#include "editor/import/cast/cast_paint.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/image/decode.h"
#include "shared/image/encode.h"
#include "shared/image/image_header.h"

namespace lararium::import {
namespace {

constexpr uint32_t kMaxSide = 8192;

Result<cv::Mat> Decode(const std::string& name,
                       std::span<const std::byte> encoded,
                       image::Channels channels) {
  const std::optional<image::ImageHeader> header = image::ReadImageHeader(encoded);
  if (!header || std::max(header->width, header->height) > kMaxSide) {
    return Status::Error(name, "cannot be read as a picture",
                         "use PNG or JPEG of at most 8192 pixels wide and high");
  }
  return image::DecodeImage(encoded, channels, name);
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

Result<cv::Mat> DecodeWithAlpha(const std::string& name,
                                std::span<const std::byte> encoded,
                                int max_size) {
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image, Decode(name, encoded, image::Channels::kBgra));
  return Reduced(image, max_size);
}

Result<human::Texture> EncodePng(const std::string& name, const cv::Mat& image) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> png, image::EncodePng(image, 9));
  return human::Texture{name, std::move(png)};
}

Result<human::Texture> EncodeJpeg(const std::string& name, const cv::Mat& image) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> jpeg, image::EncodeJpeg(image, 90));
  return human::Texture{name, std::move(jpeg)};
}

// Shifts the mean of the opaque pixels to the colour and keeps light and dark.
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
      // Images of black hair have less contrast than is expected of brown hair.
      const double shade = std::clamp(std::sqrt(std::max(grey(p), 1.0) / mean), 0.45, 1.8);
      for (int channel = 0; channel < 3; ++channel) {
        p[channel] = cv::saturate_cast<uchar>(shade * colour[2 - channel] * 255.0);
      }
    }
  }
}

// The irises are the coloured part in an image of eyes; the white has hardly any colour.
float Colourfulness(const cv::Vec4b& p) {
  const int most = std::max({p[0], p[1], p[2]});
  const int least = std::min({p[0], p[1], p[2]});
  return glm::smoothstep(0.15f, 0.3f, static_cast<float>(most - least) / std::max(most, 1));
}

void DyeIrises(cv::Mat& bgra, const glm::vec3& colour) {
  double sum = 0.0;
  double weight = 0.0;
  for (int y = 0; y < bgra.rows; ++y) {
    for (int x = 0; x < bgra.cols; ++x) {
      const cv::Vec4b& p = bgra.at<cv::Vec4b>(y, x);
      sum += Colourfulness(p) * std::max({p[0], p[1], p[2]});
      weight += Colourfulness(p);
    }
  }
  const double mean = weight > 0.0 ? std::max(sum / weight, 1.0) : 128.0;
  for (int y = 0; y < bgra.rows; ++y) {
    for (int x = 0; x < bgra.cols; ++x) {
      cv::Vec4b& p = bgra.at<cv::Vec4b>(y, x);
      const float share = Colourfulness(p);
      const double shade = std::max({p[0], p[1], p[2]}) / mean;
      for (int channel = 0; channel < 3; ++channel) {
        const double dyed = shade * colour[2 - channel] * 255.0;
        p[channel] = cv::saturate_cast<uchar>(p[channel] + share * (dyed - p[channel]));
      }
    }
  }
}

// --- Skin: images of floats, BGR or one channel, linear light.

constexpr int kSkinSize = 1024;

cv::Mat ToLinear(const cv::Mat& image) {
  cv::Mat linear;
  image.convertTo(linear, CV_32F, 1.0 / 255.0);
  cv::pow(linear, 2.2, linear);
  return linear;
}

cv::Mat ToBytes(const cv::Mat& linear) {
  cv::Mat encoded;
  cv::min(cv::max(linear, 0.0), 1.0, encoded);
  cv::pow(encoded, 1.0 / 2.2, encoded);
  encoded.convertTo(encoded, CV_8U, 255.0);
  return encoded;
}

cv::Scalar LinearBgr(const glm::vec3& colour) {
  return {std::pow(colour.b, 2.2f), std::pow(colour.g, 2.2f), std::pow(colour.r, 2.2f)};
}

// Fills one triangle of an image from the values at its corners, which are in pixels.
void FillTriangle(cv::Mat& picture, const glm::vec2 (&corners)[3], const glm::vec3& values) {
  const glm::vec2 ab = corners[1] - corners[0];
  const glm::vec2 ac = corners[2] - corners[0];
  const float doubled_area = ab.x * ac.y - ab.y * ac.x;
  if (std::abs(doubled_area) < 1e-6f) {
    return;
  }
  const glm::vec2 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
  const glm::vec2 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
  const int bottom = std::min(picture.rows - 1, static_cast<int>(high.y));
  const int right = std::min(picture.cols - 1, static_cast<int>(high.x));
  for (int y = std::max(0, static_cast<int>(low.y)); y <= bottom; ++y) {
    for (int x = std::max(0, static_cast<int>(low.x)); x <= right; ++x) {
      const glm::vec2 ap = glm::vec2(x + 0.5f, y + 0.5f) - corners[0];
      const float b = (ap.x * ac.y - ap.y * ac.x) / doubled_area;
      const float c = (ab.x * ap.y - ab.y * ap.x) / doubled_area;
      if (b >= 0.0f && c >= 0.0f && b + c <= 1.0f) {
        picture.at<float>(y, x) = glm::dot(values, glm::vec3(1.0f - b - c, b, c));
      }
    }
  }
}

// Interpolates vertex values over the triangles in texture space.
cv::Mat Spread(const SkinPaint& paint, std::span<const float> values) {
  cv::Mat picture = cv::Mat::zeros(kSkinSize, kSkinSize, CV_32F);
  if (values.size() != paint.uvs.size()) {
    return picture;
  }
  for (size_t i = 0; i + 2 < paint.indices.size(); i += 3) {
    const uint32_t* corners = &paint.indices[i];
    const glm::vec3 three(values[corners[0]], values[corners[1]], values[corners[2]]);
    if (three.x + three.y + three.z > 0.0f) {
      glm::vec2 pixels[3];
      for (int k = 0; k < 3; ++k) {
        pixels[k] = glm::clamp(paint.uvs[corners[k]], -1.0f, 2.0f) * float(kSkinSize);
      }
      FillTriangle(picture, pixels, three);
    }
  }
  cv::GaussianBlur(picture, picture, {}, 2.0);
  return picture;
}

// Band-pass noise between two scales (standard deviations of blurs, pixels), with deviation 1.
cv::Mat BandNoise(cv::RNG& random, double fine, double coarse) {
  // Noise without fine detail is computed at a lower resolution.
  const int reduced = fine >= 4.0 ? 4 : 1;
  cv::Mat noise(kSkinSize / reduced, kSkinSize / reduced, CV_32F);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  cv::Mat low;
  cv::GaussianBlur(noise, low, {}, coarse / reduced);
  if (fine > 0.0) {
    cv::GaussianBlur(noise, noise, {}, fine / reduced);
  }
  noise -= low;
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(noise, mean, deviation);
  noise /= std::max(deviation[0], 1e-6);
  if (reduced > 1) {
    cv::resize(noise, noise, {kSkinSize, kSkinSize}, 0.0, 0.0, cv::INTER_CUBIC);
  }
  return noise;
}

// skin *= 1 + amount * noise, channel by channel.
void Modulate(cv::Mat& skin, const cv::Mat& noise, const cv::Scalar& amount) {
  std::vector<cv::Mat> channels;
  cv::split(skin, channels);
  for (int c = 0; c < 3; ++c) {
    cv::Mat factor = 1.0 + amount[c] * noise;
    cv::multiply(channels[c], cv::max(factor, 0.2), channels[c]);
  }
  cv::merge(channels, skin);
}

// skin += cover * (colour - skin), with a cover of 0..1 for each pixel.
void Cover(cv::Mat& skin, const cv::Mat& cover, const cv::Scalar& colour) {
  std::vector<cv::Mat> channels;
  cv::split(skin, channels);
  for (int c = 0; c < 3; ++c) {
    channels[c] += cover.mul(colour[c] - channels[c]);
  }
  cv::merge(channels, skin);
}

void Tint(cv::Mat& skin, const SkinPaint& paint) {
  const std::vector<float> everywhere(paint.uvs.size(), 1.0f);
  cv::Mat body = Spread(paint, everywhere) > 0.5f;
  const cv::Scalar mean = cv::mean(skin, body);
  const cv::Scalar wanted = LinearBgr(*paint.tint);
  cv::multiply(skin,
               cv::Scalar(wanted[0] / std::max(mean[0], 1e-3), wanted[1] / std::max(mean[1], 1e-3),
                          wanted[2] / std::max(mean[2], 1e-3)),
               skin);
}

// Photographs of faces contain the shade of eye sockets, and some eyeshadow; both would appear
// on a closing lid. Broad shades are shifted to the colour of the cheeks; fine lines stay.
void EvenLids(cv::Mat& skin, const SkinPaint& paint) {
  constexpr double kAgainstCheeks = 0.92;
  constexpr float kShare = 0.8f;
  const cv::Mat lids = Spread(paint, paint.lids);
  const cv::Mat cheeks = Spread(paint, paint.cheeks) > 0.3f;
  if (cv::countNonZero(cheeks) == 0) {
    return;
  }
  const cv::Scalar wanted = kAgainstCheeks * cv::mean(skin, cheeks);
  cv::Mat broad;
  cv::GaussianBlur(skin, broad, {}, 2.5);
  std::vector<cv::Mat> channels;
  std::vector<cv::Mat> shades;
  cv::split(skin, channels);
  cv::split(broad, shades);
  for (size_t c = 0; c < 3; ++c) {
    cv::Mat factor = wanted[static_cast<int>(c)] / cv::max(shades[c], 1e-3);
    factor = cv::min(cv::max(factor, 0.5), 4.0);
    channels[c] = channels[c].mul(1.0 + kShare * lids.mul(factor - 1.0));
  }
  cv::merge(channels, skin);
}

// Effects of sun and years: dark areas get darker, and blood shows through in patches.
void Weather(cv::Mat& skin, float amount, cv::RNG& random) {
  if (amount <= 0.0f) {
    return;
  }
  cv::Mat smooth;
  cv::GaussianBlur(skin, smooth, {}, 14.0);
  skin += amount * 0.5 * (skin - smooth);
  Modulate(skin, BandNoise(random, 5.0, 18.0), amount * cv::Scalar(-0.04, -0.035, 0.0));
  Modulate(skin, BandNoise(random, 1.0, 3.0), amount * cv::Scalar(0.05, 0.05, 0.04));
}

// Short hairs: dots in the colour of the hair over a shade of it.
void PaintHairs(
    cv::Mat& skin, const cv::Mat& mask, const glm::vec3& colour, float amount, cv::RNG& random) {
  cv::Mat dots = 0.7 + 0.2 * BandNoise(random, 0.0, 1.5);
  cv::Mat cover = amount * mask.mul(cv::min(cv::max(dots, 0.0), 1.0));
  Cover(skin, cover, LinearBgr(colour));
}

// Shade of the hair on the scalp, fading where hair begins to grow.
void ShadeScalp(cv::Mat& skin, const SkinPaint& paint, cv::RNG& random) {
  cv::Mat mask = Spread(paint, paint.scalp);
  cv::GaussianBlur(mask, mask, {}, 5.0);
  mask = cv::min(cv::max((mask - 0.3) / 0.55, 0.0), 1.0);
  const cv::Mat uneven = 0.8 + 0.08 * BandNoise(random, 0.0, 1.5);
  Cover(skin, 0.85 * mask.mul(uneven), LinearBgr(paint.scalp_colour));
}

// Spots of one or two millimetres at the peaks of the noise, browner than the skin.
void Freckle(cv::Mat& skin, const SkinPaint& paint, cv::RNG& random) {
  if (paint.freckles.empty()) {
    return;
  }
  cv::Mat mask = Spread(paint, paint.freckles);
  cv::GaussianBlur(mask, mask, {}, 6.0);
  cv::Mat spots = (BandNoise(random, 1.1, 3.0) - 1.1) / 0.8;
  spots = cv::min(cv::max(spots, 0.0), 1.0);
  Modulate(skin, mask.mul(spots), cv::Scalar(-0.62, -0.5, -0.3));
}

// Redness of sunburnt skin, in patches.
void Burn(cv::Mat& skin, const SkinPaint& paint, cv::RNG& random) {
  if (paint.sunburn.empty()) {
    return;
  }
  cv::Mat mask = Spread(paint, paint.sunburn);
  cv::GaussianBlur(mask, mask, {}, 9.0);
  const cv::Mat patches = cv::max(1.0 + 0.25 * BandNoise(random, 6.0, 20.0), 0.0);
  Modulate(skin, mask.mul(patches), cv::Scalar(-0.42, -0.36, 0.1));
}

}  // namespace

Result<human::Texture> SkinTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const SkinPaint& paint) {
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat image, Decode(name, encoded, image::Channels::kBgr));
  cv::Mat skin;
  cv::resize(image, skin, {kSkinSize, kSkinSize}, 0.0, 0.0, cv::INTER_CUBIC);
  skin = ToLinear(skin);
  cv::RNG random(paint.seed * 0x9e3779b97f4a7c15ull + 1);
  if (paint.tint) {
    Tint(skin, paint);
  }
  EvenLids(skin, paint);
  Modulate(skin, BandNoise(random, 0.7, 1.8), cv::Scalar(0.035, 0.03, 0.025));
  Modulate(skin, BandNoise(random, 8.0, 30.0), cv::Scalar(-0.02, -0.015, 0.01));
  Weather(skin, paint.weathering, random);
  Burn(skin, paint, random);
  Freckle(skin, paint, random);
  ShadeScalp(skin, paint, random);
  PaintHairs(skin, Spread(paint, paint.beard), paint.beard_colour,
             0.95f * std::pow(paint.stubble, 1.3f), random);
  return EncodeJpeg(name, ToBytes(skin));
}

Result<human::Texture> DyedTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const std::optional<glm::vec3>& colour,
                                   int max_size) {
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image, DecodeWithAlpha(name, encoded, max_size));
  if (colour) {
    Dye(image, *colour);
  }
  return EncodePng(name, image);
}

Result<human::Texture> EyeTexture(const std::string& name,
                                  std::span<const std::byte> encoded,
                                  const std::optional<glm::vec3>& colour,
                                  int max_size) {
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image, DecodeWithAlpha(name, encoded, max_size));
  if (colour) {
    DyeIrises(image, *colour);
  }
  return EncodePng(name, image);
}

float Coverage::At(const glm::vec2& uv) const {
  if (alpha.empty()) {
    return 1.0f;
  }
  const glm::vec2 within = uv - glm::floor(uv);
  const int x = std::min(static_cast<int>(within.x * float(width)), width - 1);
  const int y = std::min(static_cast<int>(within.y * float(height)), height - 1);
  return static_cast<float>(alpha[static_cast<size_t>(y * width + x)]) / 255.0f;
}

Result<Coverage> CoverageOf(const std::string& name, std::span<const std::byte> encoded) {
  constexpr int kSize = 512;
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat image, DecodeWithAlpha(name, encoded, kSize));
  Coverage coverage{image.cols, image.rows, {}};
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      coverage.alpha.push_back(image.at<cv::Vec4b>(y, x)[3]);
    }
  }
  return coverage;
}

Result<human::Texture> OpaqueTexture(const std::string& name,
                                     std::span<const std::byte> encoded,
                                     int max_size) {
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat image, Decode(name, encoded, image::Channels::kBgr));
  return EncodeJpeg(name, Reduced(image, max_size));
}

}  // namespace lararium::import
