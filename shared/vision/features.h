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

// A keypoint in raw pixels; integer coordinates are pixel centres.
struct Keypoint {
  float x = 0.0f;
  float y = 0.0f;
  float scale = 0.0f;     // Sigma of the keypoint's Gaussian, in image pixels.
  float angle = 0.0f;     // radians, from +x towards +y
  float response = 0.0f;  // |DoG| at the extremum, in grey levels of 0..1
};

// 4x4 cells of 8 orientations, normalised to length 512, each value clamped to a byte.
inline constexpr int kDescriptorSize = 128;
using Descriptor = std::array<uint8_t, kDescriptorSize>;

struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;  // one for each keypoint

  size_t size() const { return keypoints.size(); }
};

// How finely to detect features. FeatureScaleController adapts the options from frame to frame;
// training uses fixed ones.
struct FeatureOptions {
  // -1 doubles the image first (most features), 0 starts at its own size, 1 at half its size.
  int first_octave = -1;
  int scales_per_octave = 3;
  // Minimum of Lowe's |D| after refinement times scales_per_octave, grey levels in 0..1.
  float contrast_threshold = 0.04f;
  float edge_threshold = 10.0f;  // Largest allowed ratio of the principal curvatures.
  int max_features = 0;          // Number of strongest features to keep; 0 keeps all.

  Status Validate() const;
};

// Reuses its memory from image to image; allocates nothing in steady state.
class FeatureExtractor {
 public:
  FeatureExtractor();
  ~FeatureExtractor();

  // Deterministic: the same image and options give the same features in the same order, independent
  // of the number of threads. grey is CV_8UC1.
  Status Extract(const cv::Mat& grey, const FeatureOptions& options, Features& features);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

// Extracts the features of a single image.
Result<Features> ExtractFeatures(const cv::Mat& grey, const FeatureOptions& options);

}  // namespace lararium::vision
