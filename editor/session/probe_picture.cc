#include "editor/session/probe_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "editor/bake/probe.h"
#include "editor/bake/sun_split.h"
#include "shared/core/srgb.h"
#include "shared/core/units.h"

namespace lararium::editor {
namespace {

constexpr int kWidth = 512;

// Averages blocks of pixels, so that a small sun is kept.
void Shrink(const bake::ProbeImage& image, ProbePicture& picture) {
  const int factor = std::max(1, image.width / kWidth);
  picture.width = image.width / factor;
  picture.height = image.height / factor;
  picture.radiance.assign(static_cast<size_t>(picture.width) * picture.height, glm::vec3(0.0f));
  for (int y = 0; y < picture.height * factor; ++y) {
    for (int x = 0; x < picture.width * factor; ++x) {
      picture.radiance[static_cast<size_t>(y / factor) * picture.width + x / factor] +=
          image.pixels[static_cast<size_t>(y) * image.width + x] /
          static_cast<float>(factor * factor);
    }
  }
}

// Takes the nearest texel, because the drawn picture is coarser.
glm::vec3 RadianceAt(const ProbePicture& picture, const glm::vec3& in_probe) {
  const float azimuth = std::atan2(in_probe.x, -in_probe.z);
  const float elevation = std::asin(std::clamp(in_probe.y, -1.0f, 1.0f));
  const int column = static_cast<int>((azimuth / (2.0f * kPiF) + 0.5f) * picture.width);
  const int row = static_cast<int>((0.5f - elevation / kPiF) * picture.height);
  return picture
      .radiance[static_cast<size_t>(std::clamp(row, 0, picture.height - 1)) * picture.width +
                std::clamp(column, 0, picture.width - 1)];
}

// The display value, as the renderer computes it for people: by the camera's response, or with a
// shoulder above the knee.
glm::vec3 Seen(const glm::vec3& linear, const ProbeLook& look) {
  const glm::vec3 x = glm::max(linear, 0.0f);
  if (look.response) {
    return look.response->Seen(x);
  }
  const float range = std::max(1.0f - look.knee, 1e-4f);
  return glm::min(x, look.knee) + range * (1.0f - glm::exp(-glm::max(x - look.knee, 0.0f) / range));
}

uchar Encoded(float seen) {
  return static_cast<uchar>(std::lround(255.0f * std::clamp(SrgbFromLinear(seen), 0.0f, 1.0f)));
}

cv::Vec3b Shown(const glm::vec3& radiance, const ProbeLook& look) {
  const glm::vec3 seen = Seen(radiance * look.exposure, look);
  return {Encoded(seen.b), Encoded(seen.g), Encoded(seen.r)};
}

glm::vec3 NormalAt(float x, float y) {
  const float square = x * x + y * y;
  if (square >= 1.0f) {
    return glm::vec3(x, y, 0.0f) / std::sqrt(square);
  }
  return {x, y, -std::sqrt(1.0f - square)};
}

}  // namespace

Result<ProbePicture> LoadProbePicture(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image, bake::ReadProbeImage(file));
  ProbePicture picture;
  const bake::SplitProbe split = bake::SplitSun(image);
  Shrink(image, picture);
  picture.light = bake::ProjectProbeLight(image, {});
  picture.brightest = split.brightest.direction;
  picture.is_sun = split.sun.has_value();
  picture.warnings = image.warnings;
  return picture;
}

cv::Mat DrawPanorama(const ProbePicture& picture, const ProbeLook& look, int width) {
  const int height = width / 2;
  const glm::quat probe_from_stage = glm::conjugate(look.stage_from_probe);
  cv::Mat bgr(height, width, CV_8UC3);
  for (int row = 0; row < height; ++row) {
    const float elevation = kPiF * (0.5f - (static_cast<float>(row) + 0.5f) / height);
    for (int column = 0; column < width; ++column) {
      const float azimuth = 2.0f * kPiF * ((static_cast<float>(column) + 0.5f) / width - 0.5f);
      const glm::vec3 in_stage(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                               -std::cos(elevation) * std::cos(azimuth));
      bgr.at<cv::Vec3b>(row, column) =
          Shown(RadianceAt(picture, probe_from_stage * in_stage), look);
    }
  }
  return bgr;
}

glm::vec3 MirroredDirection(const glm::quat& camera_from_stage, float x, float y) {
  const glm::vec3 normal = NormalAt(x, y);
  const glm::vec3 view(0.0f, 0.0f, 1.0f);
  const glm::vec3 mirrored = view - 2.0f * glm::dot(view, normal) * normal;
  return glm::conjugate(camera_from_stage) * mirrored;
}

cv::Mat DrawBall(const ProbePicture& picture,
                 const ProbeLook& look,
                 const glm::quat& camera_from_stage,
                 BallSurface surface,
                 float albedo,
                 int size) {
  const glm::quat probe_from_stage = glm::conjugate(look.stage_from_probe);
  const glm::quat stage_from_camera = glm::conjugate(camera_from_stage);
  cv::Mat bgr(size, size, CV_8UC3);
  for (int row = 0; row < size; ++row) {
    const float y = 2.0f * (static_cast<float>(row) + 0.5f) / size - 1.0f;
    for (int column = 0; column < size; ++column) {
      const float x = 2.0f * (static_cast<float>(column) + 0.5f) / size - 1.0f;
      glm::vec3 radiance;
      if (surface == BallSurface::kMirror) {
        const glm::vec3 in_stage = MirroredDirection(camera_from_stage, x, y);
        radiance = RadianceAt(picture, probe_from_stage * in_stage);
      } else {
        const glm::vec3 normal = probe_from_stage * (stage_from_camera * NormalAt(x, y));
        radiance = picture.light.Irradiance(normal) * (albedo / kPiF);
      }
      bgr.at<cv::Vec3b>(row, column) = Shown(radiance, look);
    }
  }
  return bgr;
}

float ExposureFor(const ProbePicture& picture) {
  constexpr float kMiddleGrey = 0.18f;
  constexpr size_t kStride = 13;  // Uses every 13th texel, for speed.
  std::vector<float> values;
  for (size_t i = 0; i < picture.radiance.size(); i += kStride) {
    const glm::vec3& texel = picture.radiance[i];
    values.push_back((texel.r + texel.g + texel.b) / 3.0f);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return kMiddleGrey / std::max(*middle, 1e-6f);
}

}  // namespace lararium::editor
