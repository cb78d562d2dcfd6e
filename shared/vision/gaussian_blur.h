#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace lararium::vision {

// Convolves with Gaussians; keeps its memory from image to image.
class GaussianBlur {
 public:
  // image: CV_32FC1; sigma in pixels, the kernel ends at 3 sigma, and the image is
  // mirrored about its outer pixels. blurred may not share pixels with it. Rows run in parallel.
  void Apply(const cv::Mat& image, float sigma, cv::Mat& blurred);

 private:
  struct Job {
    std::vector<float> row;
    std::vector<const float*> taps;
  };
  std::vector<float> kernel_;  // the centre and one side, of sum 1
  std::vector<Job> jobs_;
};

}  // namespace lararium::vision
