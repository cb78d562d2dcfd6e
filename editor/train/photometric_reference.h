#pragma once

// The photometric reference of a map: the colours of its points, independent of the gains (exposure
// and white balance) of the training images.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "shared/vision/photometry.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// The colour of a point in one image.
struct ColourObservation {
  uint32_t point = 0;
  uint32_t keyframe = 0;
  vision::LinearColour colour;
};

struct PhotometricReference {
  std::vector<Eigen::Vector3f> colours;     // [points]: See SceneDatabase::colours.
  std::vector<std::array<float, 3>> gains;  // [keyframes]: See Keyframe::gain.
};

// Solves colour * gain = observation for gains and colours, channel by channel: weighted least
// squares of the logarithms with Cauchy's loss, whose width follows the noise. Colours are
// eliminated from the normal equations (Schur complement), so that gains agree across long chains
// of images.
//
// known: [points] Colours that stay fixed; a channel is negative if it is unknown. Without any
// known colour, the gains are scaled so that the median of their logarithms is 0. Keyframes that
// share no points with others get gain 1.
PhotometricReference SolvePhotometry(std::span<const ColourObservation> observations,
                                     size_t keyframe_count,
                                     std::span<const Eigen::Vector3f> known);

// Fills in database.colours, and the gains of the keyframes whose colour image is given: bgr[k] is
// that of keyframe k, CV_8UC3 of the camera's size, or empty. Colours that the database already has
// stay fixed, so the reference does not change.
void FillPhotometry(vision::SceneDatabase& database, std::span<const cv::Mat> bgr);

}  // namespace lararium::train
