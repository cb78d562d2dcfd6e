#include "shared/vision/scale_space.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

namespace lararium::vision {
namespace {

constexpr int kScales = 3;

cv::Mat Noise(int width, int height) {
  cv::Mat grey(height, width, CV_8UC1);
  cv::RNG(7).fill(grey, cv::RNG::UNIFORM, 0, 256);
  return grey;
}

std::vector<const uchar*> Memory(const ScaleSpace& space) {
  std::vector<const uchar*> memory;
  for (const Octave& octave : space.octaves()) {
    for (const cv::Mat& image : octave.gaussians) {
      memory.push_back(image.data);
    }
  }
  return memory;
}

// Expects the same octaves as in a new scale space.
void ExpectAsIfNew(const ScaleSpace& space, const cv::Mat& grey, int first_octave) {
  ScaleSpace fresh;
  fresh.Build(grey, first_octave, kScales);
  ASSERT_EQ(space.octaves().size(), fresh.octaves().size());
  for (size_t o = 0; o < fresh.octaves().size(); ++o) {
    const Octave& octave = space.octaves()[o];
    const Octave& expected = fresh.octaves()[o];
    EXPECT_EQ(octave.pixel_size, expected.pixel_size);
    EXPECT_EQ(octave.origin, expected.origin);
    for (size_t level = 0; level < expected.gaussians.size(); ++level) {
      ASSERT_EQ(octave.gaussians[level].size(), expected.gaussians[level].size());
      EXPECT_EQ(cv::norm(octave.gaussians[level], expected.gaussians[level], cv::NORM_INF), 0.0);
    }
  }
}

TEST(ScaleSpace, ImagesOfOneSizeTakeNoMemoryAnewWhicheverOctaveTheyBeginWith) {
  const cv::Mat grey = Noise(160, 120);
  ScaleSpace space;
  for (const int first_octave : {-1, 0, 1}) {
    space.Build(grey, first_octave, kScales);
  }
  for (const int first_octave : {-1, 0, 1}) {
    space.Build(grey, first_octave, kScales);
    const std::vector<const uchar*> before = Memory(space);
    for (const int between : {1, -1, 0}) {
      space.Build(grey, between, kScales);
    }
    space.Build(grey, first_octave, kScales);
    EXPECT_EQ(Memory(space), before) << first_octave;
  }
}

TEST(ScaleSpace, WhatItHeldBeforeChangesNothing) {
  const cv::Mat grey = Noise(161, 119);
  ScaleSpace space;
  for (const int first_octave : {0, -1, 2, 0, 1}) {
    space.Build(Noise(200, 150), first_octave, kScales);
    space.Build(grey, first_octave, kScales);
    ExpectAsIfNew(space, grey, first_octave);
  }
}

TEST(ScaleSpace, ImagesTooSmallForAnExtremumHaveNoOctaves) {
  ScaleSpace space;
  space.Build(Noise(12, 9), 3, kScales);
  EXPECT_TRUE(space.octaves().empty());
}

}  // namespace
}  // namespace lararium::vision
