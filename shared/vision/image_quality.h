#pragma once

// Measures how noisy and how sharp a camera's images are, so that rendered content can be matched
// to them.

#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

namespace lararium::vision {

// Noise model of the encoded image, values 0..1: variance = floor^2 + slope * value.
struct ImageNoise {
  double floor = 0.0;
  double slope = 0.0;
};

// Estimates the noise from the smoothest blocks of images (CV_8UC1 or CV_8UC3, of one camera, at
// least 64 pixels wide and high). The variance of a block is the response to a mask that ignores
// edges and ramps (Immerkaer, "Fast Noise Variance Estimation", CVIU 1996). For each brightness
// level, the calmest blocks count; a line is fitted through their variances by least squares, with
// floor and slope not negative. Saturated blocks are left out. nullopt if no image is usable or too
// few blocks are smooth.
std::optional<ImageNoise> EstimateNoise(std::span<const cv::Mat> images);

// Estimates the blur of the images as the standard deviation, in pixels, of a Gaussian. Step edges
// are re-blurred, and the ratio of the gradients gives their blur (Zhuo & Sim, "Defocus Map
// Estimation from a Single Image", Pattern Recognition 2011). The result is a low quantile over all
// clear edges of all images, because softer edges belong to soft objects. Thin lines are left out.
// Takes the same kinds of images as EstimateNoise. nullopt if there are too few edges.
std::optional<double> EstimateSharpness(std::span<const cv::Mat> images);

}  // namespace lararium::vision
