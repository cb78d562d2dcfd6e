#pragma once

// The photometric reference of a map: what its points look like, apart from the
// gains (exposure and white balance) of the images that showed them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "shared/vision/photometry.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// What an image shows of a point.
struct ColourSight {
  uint32_t point = 0;
  uint32_t keyframe = 0;
  vision::LinearColour colour;
};

struct PhotometricReference {
  std::vector<Eigen::Vector3f> colours;     // [points], as SceneDatabase::colours
  std::vector<std::array<float, 3>> gains;  // [keyframes], as Keyframe::gain
};

// The gains and colours with colour * gain = sight, channel by channel: weighted
// least squares of logarithms under Cauchy's loss, whose width follows the noise.
// Colours are eliminated from the normal equations (Schur complement), so that
// gains agree across long chains of images.
// known: [points] colours that hold still, a channel negative where it is not
// known. Without any, the median of the logarithms of the gains is 0. Keyframes
// that nothing ties to others get gain 1.
PhotometricReference SolvePhotometry(std::span<const ColourSight> sights,
                                     size_t keyframe_count,
                                     std::span<const Eigen::Vector3f> known);

// Solves for database.colours, and for the gains of the keyframes whose image is
// at hand: bgr[k] is keyframe k, CV_8UC3 of the camera's size, or empty. Colours
// that the database has already hold still, and with them the reference.
void FillPhotometry(vision::SceneDatabase& database, std::span<const cv::Mat> bgr);

}  // namespace lararium::train
