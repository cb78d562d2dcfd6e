#pragma once

// The dominant gradient directions around a keypoint: Lowe, IJCV 2004, section 5.

#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/vision/extrema.h"
#include "shared/vision/gradients.h"

namespace lararium::vision {

struct OrientedExtremum {
  Extremum extremum;
  float angle = 0.0f;  // radians, [0, 2 pi)
};

// Working memory of one thread.
struct OrientationMemory {
  GradientRow gradients;
  std::vector<float> weights_x;
  std::vector<float> weights_y;
};

// Appends one copy of the extremum for every histogram peak that reaches 0.8 of the highest one.
// image is the extremum's level of the scale space.
void AddOrientations(const cv::Mat& image,
                     const Extremum& extremum,
                     OrientationMemory& memory,
                     std::vector<OrientedExtremum>& out);

}  // namespace lararium::vision
