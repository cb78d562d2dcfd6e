#pragma once

// Filters of small images that, unlike OpenCV's, allocate nothing once their images have their
// sizes. Outside an image the values of its border are repeated.

#include <opencv2/core/mat.hpp>
#include <vector>

namespace lararium::vision {

// The mean over a square window.
class WindowMean {
 public:
  // from: floats, of any number of channels. window: odd. to: is filled; another image than from.
  void Apply(const cv::Mat& from, int window, cv::Mat& to);

 private:
  std::vector<double> columns_;  // Sums over the rows of the window.
};

// The least and the greatest values of windows of 3 x 3 pixels. from: CV_32FC1, another image than
// to.
void LeastAround(const cv::Mat& from, cv::Mat& to);
void GreatestAround(const cv::Mat& from, cv::Mat& to);

}  // namespace lararium::vision
