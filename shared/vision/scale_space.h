#pragma once

// The Gaussian and difference-of-Gaussian pyramid of Lowe, IJCV 2004, section 3.
// Used by feature extraction only.

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "shared/vision/gaussian_blur.h"

namespace lararium::vision {

// Blur of an octave's first level, in pixels of the octave.
inline constexpr float kBaseSigma = 1.6f;

// Levels of one sampling: level l is blurred to kBaseSigma * 2^(l / scales)
// octave pixels. A pixel x of the octave lies at image pixel
// pixel_size * x + origin.
struct Octave {
  float pixel_size = 1.0f;
  float origin = 0.0f;
  std::vector<cv::Mat> gaussians;  // CV_32FC1 [scales + 3], grey 0..1

  int rows() const { return gaussians[0].rows; }
  int columns() const { return gaussians[0].cols; }
  // The differences of Gaussians: level l is that of l + 1 minus that of l. They are worked out
  // where they are looked at: kept, they would be as large as all the rest.
  int difference_levels() const { return static_cast<int>(gaussians.size()) - 1; }
  float Difference(int level, int row, int column) const {
    return gaussians[level + 1].at<float>(row, column) - gaussians[level].at<float>(row, column);
  }
};

// Keeps its memory from image to image: images of one size find it again, whichever octave each
// begins with.
class ScaleSpace {
 public:
  // grey: CV_8UC1, assumed blurred by 0.5 pixels. first_octave: -1 doubles the
  // image, 0 starts with it, each 1 more starts at half the size. Stops when an
  // octave would be too small to hold an extremum.
  void Build(const cv::Mat& grey, int first_octave, int scales_per_octave);

  std::span<const Octave> octaves() const { return {octaves_.data() + first_, count_}; }

 private:
  // An image as an octave begins with it.
  struct Sampled {
    cv::Mat image;       // CV_32FC1, 0..1
    float sigma = 0.0f;  // the blur that it has, its own pixels
    float pixel_size = 1.0f;
    float origin = 0.0f;
  };
  const Sampled& Sample(const cv::Mat& grey, int first_octave);

  // By how often the image is halved: the doubled one first, then the image itself.
  std::vector<Octave> octaves_;
  size_t first_ = 0;
  size_t count_ = 0;
  GaussianBlur blur_;
  std::vector<Sampled> sampled_;  // likewise
};

}  // namespace lararium::vision
