#include "editor/bake/probe.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>

#include "editor/bake/exr_image.h"
#include "editor/bake/radiance.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"

namespace lararium::bake {
namespace {

constexpr int kMaxWidth = 16384;
// Negative texels up to this share of the mean in magnitude count as ringing.
constexpr double kMaxRinging = 0.05;
// Outdoors or by a window the brightest texel exceeds the mean by a large factor.
constexpr double kLowDynamicRange = 4.0;

enum class Shape { kProbe, kAny };

Status CheckSize(const std::string& where, Shape shape, int64_t width, int64_t height) {
  if (shape == Shape::kAny && std::min(width, height) >= 8 &&
      std::max(width, height) <= kMaxWidth) {
    return Status();
  }
  if (width >= 8 && width < 2 * height && 2 * width > height) {
    return Status::Error(where,
                         "the probe is " + std::to_string(width) + " x " + std::to_string(height) +
                             ", not twice as wide as high",
                         "if it is a photograph of a mirror ball, unwrap it: lararium-editor probe "
                         "ball");
  }
  if (width < 8 || width > kMaxWidth || width != 2 * height) {
    return Status::Error(where,
                         "the probe is " + std::to_string(width) + " x " + std::to_string(height),
                         "a probe is equirectangular, twice as wide as high, 8 to " +
                             std::to_string(kMaxWidth) + " pixels wide");
  }
  return Status();
}

std::string PixelName(const ProbeImage& image, size_t index) {
  return "pixel (" + std::to_string(index % image.width) + ", " +
         std::to_string(index / image.width) + ")";
}

float Smallest(const glm::vec3& v) { return std::min({v.r, v.g, v.b}); }

bool IsFinite(const glm::vec3& texel) {
  return std::isfinite(texel.r) && std::isfinite(texel.g) && std::isfinite(texel.b);
}

// The mean of the finite ones among the eight neighbours; 0 if there are none.
glm::vec3 MeanOfNeighbours(const ProbeImage& image, size_t index) {
  const int column = static_cast<int>(index % static_cast<size_t>(image.width));
  const int row = static_cast<int>(index / static_cast<size_t>(image.width));
  glm::vec3 sum(0.0f);
  int count = 0;
  for (int y = std::max(0, row - 1); y <= std::min(image.height - 1, row + 1); ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      const int wrapped = (x + image.width) % image.width;
      const glm::vec3& texel = image.pixels[static_cast<size_t>(y) * image.width + wrapped];
      if (IsFinite(texel)) {
        sum += texel;
        ++count;
      }
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : sum;
}

// Must run before holes are filled, so that infinite texels are not treated as holes.
void MendOverflow(ProbeImage& image) {
  constexpr float kLargestHalf = 65504.0f;
  size_t count = 0;
  for (glm::vec3& texel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      if (std::isinf(texel[c]) && texel[c] > 0.0f) {
        texel[c] = kLargestHalf;
        ++count;
      }
    }
  }
  if (count > 0) {
    image.warnings.push_back(std::to_string(count) +
                             " infinite values were set to 65504; the sun may be too weak: save "
                             "the image with 32-bit floats");
  }
}

Status MendHoles(ProbeImage& image, const std::string& where) {
  constexpr size_t kOneIn = 1000;
  std::vector<size_t> holes;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    if (!IsFinite(image.pixels[i])) {
      holes.push_back(i);
    }
  }
  if (holes.empty()) {
    return Status();
  }
  const std::string first = PixelName(image, holes.front()) + " is not a number";
  if (holes.size() > std::max<size_t>(1, image.pixels.size() / kOneIn)) {
    return Status::Error(where,
                         first + ", and " + std::to_string(holes.size() - 1) + " others are not",
                         "repair the image where it was made");
  }
  std::vector<glm::vec3> mended;
  for (const size_t hole : holes) {
    mended.push_back(MeanOfNeighbours(image, hole));
  }
  for (size_t i = 0; i < holes.size(); ++i) {
    image.pixels[holes[i]] = mended[i];
  }
  image.warnings.push_back(first + "; " + std::to_string(holes.size()) +
                           " such took the mean of their neighbours");
  return Status();
}

// Mean over pixels and channels.
double MeanRadiance(const ProbeImage& image) {
  double sum = 0.0;
  for (const glm::vec3& texel : image.pixels) {
    sum += (static_cast<double>(texel.r) + texel.g + texel.b) / 3.0;
  }
  return sum / static_cast<double>(image.pixels.size());
}

Status ClampNegatives(ProbeImage& image, double mean, const std::string& where) {
  size_t count = 0;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float smallest = Smallest(image.pixels[i]);
    if (smallest < -kMaxRinging * mean) {
      return Status::Error(where, PixelName(image, i) + " is negative",
                           "radiance cannot be negative; repair the image where it was made");
    }
    if (smallest < 0.0f) {
      image.pixels[i] = glm::max(image.pixels[i], glm::vec3(0.0f));
      ++count;
    }
  }
  if (count > 0) {
    image.warnings.push_back(std::to_string(count) + " slightly negative pixels were set to 0");
  }
  return Status();
}

void WarnOfLowRange(ProbeImage& image, double mean) {
  double brightest = 0.0;
  for (const glm::vec3& texel : image.pixels) {
    brightest = std::max({brightest, static_cast<double>(texel.r), static_cast<double>(texel.g),
                          static_cast<double>(texel.b)});
  }
  if (brightest < kLowDynamicRange * mean) {
    image.warnings.push_back(
        "the brightest pixel is less than four times the mean: perhaps not a high-dynamic-range "
        "image; lamps and the sun would be too weak: merge a bracketed series, lararium-editor "
        "probe merge");
  }
}

// The first bytes say which of the two formats a file has, because suffixes are often wrong.
Result<ProbeImage> ReadByContent(const std::filesystem::path& file, Shape shape) {
  const std::string where = file.string();
  const std::string extension = LowerCase(file.extension().string());
  for (const char* photograph :
       {".jpg", ".jpeg", ".png", ".tif", ".tiff", ".heic", ".avif", ".webp"}) {
    if (extension == photograph) {
      return Status::Error(where, "a photograph has too small a range of brightness",
                           "merge a bracketed series of them: lararium-editor probe merge");
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(const MappedFile mapped, MappedFile::Open(file));
  const std::string_view content(reinterpret_cast<const char*>(mapped.bytes().data()),
                                 mapped.bytes().size());
  if (content.starts_with("\x76\x2f\x31\x01")) {
    return ReadExr(file, [&](int64_t width, int64_t height) {
      return CheckSize(where, shape, width, height);
    });
  }
  if (content.starts_with("#?")) {
    LARARIUM_ASSIGN_OR_RETURN(ProbeImage image, ParseRadiance(mapped.bytes(), where));
    LARARIUM_RETURN_IF_ERROR(CheckSize(where, shape, image.width, image.height));
    return image;
  }
  return Status::Error(where, "is not an HDR image of a supported format, or is damaged",
                       "use OpenEXR (.exr) or Radiance (.hdr)");
}

Result<ProbeImage> Read(const std::filesystem::path& file, Shape shape) {
  LARARIUM_ASSIGN_OR_RETURN(ProbeImage image, ReadByContent(file, shape));
  MendOverflow(image);
  LARARIUM_RETURN_IF_ERROR(MendHoles(image, file.string()));
  const double mean = MeanRadiance(image);
  if (!(mean > 0.0)) {
    return Status::Error(file.string(), "the probe is black", "use an image that contains light");
  }
  LARARIUM_RETURN_IF_ERROR(ClampNegatives(image, mean, file.string()));
  WarnOfLowRange(image, mean);
  return image;
}

}  // namespace

Result<ProbeImage> ReadProbeImage(const std::filesystem::path& file) {
  return Read(file, Shape::kProbe);
}

Result<ProbeImage> ReadHdrPicture(const std::filesystem::path& file) {
  return Read(file, Shape::kAny);
}

}  // namespace lararium::bake
