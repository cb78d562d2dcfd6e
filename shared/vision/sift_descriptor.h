#pragma once

// The histogram of gradients around a keypoint: Lowe, IJCV 2004, section 6.

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/vision/features.h"
#include "shared/vision/gradients.h"
#include "shared/vision/orientation.h"

namespace lararium::vision {

// Samples of part of a row in a descriptor's own axes.
struct SampleRow {
  std::vector<float> angle_bin;
  std::vector<int32_t> cell;  // the first of the four that a sample falls between
  std::array<std::vector<float>, 4> share;

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

// Working memory; keep one for each thread.
struct DescriptorMemory {
  GradientRow gradients;
  SampleRow samples;
  std::vector<float> weights_x;
  std::vector<float> weights_y;
};

// image: the extremum's level of the scale space.
Descriptor Describe(const cv::Mat& image,
                    const OrientedExtremum& oriented,
                    DescriptorMemory& memory);

}  // namespace lararium::vision
