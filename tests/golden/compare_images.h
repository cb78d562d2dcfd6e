#pragma once

// Compares pictures within bounds, because drivers differ in the last digit.

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace lararium::test {

struct ImageBounds {
  double max = 0.0;   // Maximum of the absolute difference over all pixels and channels.
  double mean = 0.0;  // Mean of the absolute difference over all pixels and channels.
};

// Succeeds if both bounds hold; otherwise the message says by how much and where they are exceeded.
inline testing::AssertionResult ImagesAgree(const cv::Mat& actual,
                                            const cv::Mat& expected,
                                            const ImageBounds& bounds) {
  if (actual.size() != expected.size() || actual.type() != expected.type()) {
    return testing::AssertionFailure()
           << "sizes or types differ: " << actual.size() << " and " << expected.size();
  }
  cv::Mat difference;
  cv::absdiff(actual.reshape(1), expected.reshape(1), difference);
  double max = 0.0;
  cv::Point where;
  cv::minMaxLoc(difference, nullptr, &max, nullptr, &where);
  const double mean = cv::mean(difference)[0];
  if (max <= bounds.max && mean <= bounds.mean) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure()
         << "largest difference " << max << " (bound " << bounds.max << ") at column "
         << where.x / actual.channels() << ", row " << where.y << "; mean " << mean << " (bound "
         << bounds.mean << ")";
}

}  // namespace lararium::test
