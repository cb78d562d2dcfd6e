#pragma once

#include <opencv2/core/mat.hpp>

namespace lararium::vision {

// Convolves a CV_32FC1 image with a Gaussian of sigma pixels, cut off at 3 sigma,
// with the image mirrored about its outer pixels. difference, when given, becomes
// blurred minus image. Neither may share pixels with image. Rows run in parallel.
void GaussianBlur(const cv::Mat& image, float sigma, cv::Mat& blurred, cv::Mat* difference);

}  // namespace lararium::vision
