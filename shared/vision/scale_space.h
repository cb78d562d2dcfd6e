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

// The levels that share one sampling. Level l is blurred to kBaseSigma * 2^(l / scales) octave
// pixels. Octave pixel x lies at image pixel pixel_size * x + origin.
struct Octave {
  float pixel_size = 1.0f;
  float origin = 0.0f;
  std::vector<cv::Mat> gaussians;  // CV_32FC1 [scales + 3], grey 0..1

  int rows() const { return gaussians[0].rows; }
  int columns() const { return gaussians[0].cols; }
  // Differences of Gaussians: difference level l is gaussians[l + 1] - gaussians[l]. They are
  // computed on demand, because storing them would double the memory.
  int difference_levels() const { return static_cast<int>(gaussians.size()) - 1; }
  float Difference(int level, int row, int column) const {
    return gaussians[level + 1].at<float>(row, column) - gaussians[level].at<float>(row, column);
  }
};

// Reuses its memory from image to image. Images of one size do not allocate again, even when they
// start with different octaves.
class ScaleSpace {
 public:
  // grey is CV_8UC1 and assumed to be blurred by 0.5 pixels. first_octave: -1 doubles the image,
  // 0 starts at its own size, and each further step halves the size. Stops when an octave would be
  // too small to hold an extremum.
  void Build(const cv::Mat& grey, int first_octave, int scales_per_octave);

  std::span<const Octave> octaves() const { return {octaves_.data() + first_, count_}; }

 private:
  // The resampled image from which an octave is built.
  struct Sampled {
    cv::Mat image;       // CV_32FC1, 0..1
    float sigma = 0.0f;  // Blur of `image`, in its own pixels.
    float pixel_size = 1.0f;
    float origin = 0.0f;
  };
  const Sampled& Sample(const cv::Mat& grey, int first_octave);

  // octaves_[i] and sampled_[i] are at 2^(1 - i) times the image's size: the doubled image comes
  // first, then the image itself.
  std::vector<Octave> octaves_;
  size_t first_ = 0;
  size_t count_ = 0;
  GaussianBlur blur_;
  std::vector<Sampled> sampled_;
};

}  // namespace lararium::vision
