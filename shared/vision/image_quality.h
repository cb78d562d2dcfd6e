#pragma once

// How noisy and how sharp a camera's images are, so that what is drawn into them can be made
// alike.

#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

namespace lararium::vision {

// Of the encoded image, values 0..1: variance = floor^2 + slope * value.
struct ImageNoise {
  double floor = 0.0;
  double slope = 0.0;
};

// From what images (CV_8UC1 or CV_8UC3, of one camera, at least 64 pixels wide and high) show
// on the smoothest places: the response to a mask that ignores edges and ramps (Immerkaer,
// "Fast Noise Variance Estimation", CVIU 1996), by brightness, of the calmest blocks there; a
// line through the variances (least squares, neither part negative). Nothing where no image
// is fit or too few places are smooth. Saturated places are left out.
std::optional<ImageNoise> EstimateNoise(std::span<const cv::Mat> images);

// The standard deviation, in pixels, of the Gaussian that an image's sharpest edges look
// blurred with: steps of brightness are re-blurred and the ratio of gradients says how soft
// they were (Zhuo & Sim, "Defocus Map Estimation from a Single Image", Pattern Recognition
// 2011); a low quantile over all clear steps of all images, since softer ones are those of
// soft things. Thin lines are left out. As above. Nothing where there are too few edges.
std::optional<double> EstimateSharpness(std::span<const cv::Mat> images);

}  // namespace lararium::vision
