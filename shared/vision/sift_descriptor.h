#pragma once

// The histogram of gradient orientations around a keypoint: Lowe, IJCV 2004, section 6.

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/vision/features.h"
#include "shared/vision/gradients.h"
#include "shared/vision/orientation.h"

namespace lararium::vision {

// The gradient samples of part of an image row, in the descriptor's axes; parallel arrays.
struct SampleRow {
  std::vector<float> angle_bin;
  std::vector<int32_t> cell;  // First of the four cells between which the sample is interpolated.
  std::array<std::vector<float>, 4> share;  // Weight of the sample in each of the four cells.

  void Reserve(size_t count) {
    if (cell.size() < count) {
      cell.resize(count);
      angle_bin.resize(count);
      for (std::vector<float>& values : share) {
        values.resize(count);
      }
    }
  }
};

// Working memory of one thread.
struct DescriptorMemory {
  GradientRow gradients;
  SampleRow samples;
  std::vector<float> weights_x;
  std::vector<float> weights_y;
};

// Computes the descriptor. image is the extremum's level of the scale space.
Descriptor Describe(const cv::Mat& image,
                    const OrientedExtremum& oriented,
                    DescriptorMemory& memory);

}  // namespace lararium::vision
