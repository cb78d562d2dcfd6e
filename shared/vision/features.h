#pragma once

// Scale-invariant features: Lowe, "Distinctive Image Features from
// Scale-Invariant Keypoints", IJCV 2004.

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/core/status.h"

namespace lararium::vision {

// A keypoint at a raw pixel (integer coordinates are pixel centres).
struct Keypoint {
  float x = 0.0f;
  float y = 0.0f;
  float scale = 0.0f;     // sigma of its Gaussian, in pixels of the image
  float angle = 0.0f;     // radians, from +x towards +y
  float response = 0.0f;  // |DoG| at the extremum, in grey levels of 0..1
};

// 4x4 cells of 8 orientations, normalised to length 512, clamped to a byte.
inline constexpr int kDescriptorSize = 128;
using Descriptor = std::array<uint8_t, kDescriptorSize>;

struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;  // one for each keypoint

  size_t size() const { return keypoints.size(); }
};

// How finely to look. The level-of-detail controller chooses these from frame
// to frame; training uses the finest.
struct FeatureOptions {
  // -1 doubles the image first (most features), 0 starts at its own size, 1 at half.
  int first_octave = -1;
  int scales_per_octave = 3;
  float contrast_threshold =
      0.04f;                     // Lowe's |D| after refinement, grey 0..1, times scales_per_octave
  float edge_threshold = 10.0f;  // largest ratio of principal curvatures
  int max_features = 0;          // keep those of strongest response; 0: all

  Status Validate() const;
};

// Keeps its memory from image to image: allocates nothing in steady state.
class FeatureExtractor {
 public:
  FeatureExtractor();
  ~FeatureExtractor();

  // Deterministic: the same image and options give the same features in the same
  // order, whatever the number of threads. grey: CV_8UC1.
  Status Extract(const cv::Mat& grey, const FeatureOptions& options, Features& features);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

// The same for a single image.
Result<Features> ExtractFeatures(const cv::Mat& grey, const FeatureOptions& options);

}  // namespace lararium::vision
