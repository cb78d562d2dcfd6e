#pragma once

// The computations of the light panel, without drawing.

#include <Eigen/Core>
#include <array>
#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "editor/panels/viewport/view_camera.h"
#include "shared/stage/place.h"

namespace lararium::panels {

// Conversion between a point of an equirectangular picture (bake/probe.h), x right and y down in
// 0..1, and a unit vector.
glm::vec3 PanoramaDirection(double x, double y);
Eigen::Vector2d PanoramaPoint(const glm::vec3& direction);

// The first intersection of a ray with the occluders of a place, or with the floor (y = 0) where it
// meets no occluder.
struct SurfacePoint {
  glm::vec3 point = glm::vec3(0.0f);  // Metres, stage axes.
  // A unit vector on the side from which the ray comes.
  glm::vec3 normal = glm::vec3(0.0f, 1.0f, 0.0f);
};
std::optional<SurfacePoint> FindSurface(const Ray& ray_in_stage,
                                        std::span<const stage::Occluder> occluders);

// Histogram of the luminance of encoded (sRGB) pixels.
struct BrightnessHistogram {
  static constexpr int kBins = 64;
  std::array<int, kBins> counts = {};
  int total = 0;

  void Add(uchar luminance);
  double Median() const;  // 0..1; 0 where the histogram is empty.
};
struct BrightnessComparison {
  BrightnessHistogram real;    // Pixels of the camera's image alone.
  BrightnessHistogram people;  // Pixels that people and objects cover completely.
};
// composite and plain: bgr. coverage: CV_8UC1, 255 where people and objects cover the pixel
// completely. All must have the same size, otherwise the result is empty.
BrightnessComparison CompareBrightness(const cv::Mat& plain,
                                       const cv::Mat& composite,
                                       const cv::Mat& coverage);

// The mean of a square around a pixel, linear R, G, B; the square is cut at borders. half: half of
// its side. nullopt where the pixel is outside the image.
std::optional<glm::vec3> MeanLinear(const cv::Mat& bgr, const Eigen::Vector2d& pixel, int half);

}  // namespace lararium::panels
