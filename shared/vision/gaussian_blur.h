#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace lararium::vision {

// Convolves images with Gaussians. Reuses its memory from image to image.
class GaussianBlur {
 public:
  // image is CV_32FC1, sigma is in pixels. The kernel ends at 3 sigma, and the image is mirrored
  // about its outer pixels. blurred must not share pixels with image. Rows run in parallel.
  void Apply(const cv::Mat& image, float sigma, cv::Mat& blurred);

 private:
  struct Job {
    std::vector<float> row;
    std::vector<const float*> taps;
  };
  std::vector<float> kernel_;  // Centre and one side of the kernel; the whole kernel sums to 1.
  std::vector<Job> jobs_;
};

}  // namespace lararium::vision
