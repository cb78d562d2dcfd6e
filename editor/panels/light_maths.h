#pragma once

// What the light panel computes, apart from what it draws.

#include <Eigen/Core>
#include <array>
#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "editor/panels/view_camera.h"
#include "shared/stage/place.h"

namespace lararium::panels {

// Of an equirectangular picture (bake/probe.h), x right and y down over 0..1. Unit vectors.
glm::vec3 PanoramaDirection(double x, double y);
Eigen::Vector2d PanoramaPoint(const glm::vec3& direction);

// What a ray meets first of a place's occluders, and its floor (y = 0) where it meets none.
struct SurfacePoint {
  glm::vec3 point = glm::vec3(0.0f);               // metres, stage axes
  glm::vec3 normal = glm::vec3(0.0f, 1.0f, 0.0f);  // unit, towards where the ray comes from
};
std::optional<SurfacePoint> FindSurface(const Ray& ray_in_stage,
                                        std::span<const stage::Occluder> occluders);

// How bright pixels are: luminance of the encoded picture, counted.
struct BrightnessHistogram {
  static constexpr int kBins = 64;
  std::array<int, kBins> counts = {};
  int total = 0;

  void Add(uchar luminance);
  double Median() const;  // 0..1; 0 of nothing
};
struct BrightnessComparison {
  BrightnessHistogram real;    // of the camera's image alone
  BrightnessHistogram people;  // of pixels that people and props cover wholly
};
// composite and plain: bgr; coverage: CV_8UC1, 255 where nothing else is seen. All of one
// size; others compare nothing.
BrightnessComparison CompareBrightness(const cv::Mat& plain,
                                       const cv::Mat& composite,
                                       const cv::Mat& coverage);

// The mean of the square of that half-width about a pixel, linear, R, G, B; less at borders.
// Nothing where the pixel is outside.
std::optional<glm::vec3> MeanLinear(const cv::Mat& bgr, const Eigen::Vector2d& pixel, int half);

}  // namespace lararium::panels
