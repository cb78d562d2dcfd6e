#pragma once

// Samples the brightness of an image. Training uses it to write the photometric reference
// (SceneDatabase::colours), and the player uses the same code to compare images with it.

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace lararium::vision {

// The linear value, 0..1, of an sRGB-encoded byte (IEC 61966-2-1).
float LinearFromSrgb(uint8_t encoded);
// Linear RGB, CV_32FC3, of an image in 8-bit sRGB BGR (CV_8UC3).
cv::Mat LinearFromSrgb(const cv::Mat& bgr);

struct LinearColour {
  Eigen::Vector3f rgb;  // Linear R, G, B in 0..1.
  // Weight of each channel, 0..1: how reliably its value is proportional to the light. 0 where the
  // channel is clipped or drowned in noise; below 1 in highlights, which cameras compress, and in
  // deep shadow.
  Eigen::Vector3f weight;
};

// The colour of bgr (CV_8UC3, sRGB) at a raw pixel: the mean of the decoded values of the
// kSampleSize x kSampleSize pixels around the nearest pixel. nullopt if these are not all inside
// the image.
//
// The gain of an image at a map point is rgb / SceneDatabase::colours, for each channel whose
// weight is positive and whose colour is not negative. The uncertainty of the gain's logarithm is
// about the same over the whole range.
inline constexpr int kSampleSize = 5;
std::optional<LinearColour> SampleLinear(const cv::Mat& bgr, float x, float y);

}  // namespace lararium::vision
