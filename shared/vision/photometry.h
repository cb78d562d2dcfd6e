#pragma once

// How bright an image shows a place: the one way in which training writes the
// photometric reference (SceneDatabase::colours) and the player reads it.

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace lararium::vision {

// The linear value, 0..1, of an sRGB-encoded byte (IEC 61966-2-1).
float LinearFromSrgb(uint8_t encoded);

struct LinearColour {
  Eigen::Vector3f rgb;  // linear R, G, B of 0..1
  // Of each channel, 0..1: how far its value may be trusted to be proportional to
  // the light. 0 where it is clipped or drowns in noise; less than 1 in the
  // highlights, which cameras compress, and in deep shadow.
  Eigen::Vector3f weight;
};

// What bgr (CV_8UC3, sRGB) shows at a raw pixel: the mean of the decoded values
// of the kSampleSize x kSampleSize pixels around the nearest one. nullopt where
// these are not all inside the image.
//
// The gain of an image at a point of the map is, channel by channel,
// rgb / SceneDatabase::colours, wherever weight > 0 and the colour is not
// negative; its uncertainty is that of a logarithm, alike over the whole range.
inline constexpr int kSampleSize = 5;
std::optional<LinearColour> SampleLinear(const cv::Mat& bgr, float x, float y);

}  // namespace lararium::vision
