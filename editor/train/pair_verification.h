#pragma once

// Matches image pairs and keeps those whose matches agree with one two-view geometry.

#include <optional>
#include <span>
#include <vector>

#include "editor/train/pair_selection.h"
#include "editor/train/tracks.h"
#include "editor/train/training_camera.h"
#include "shared/core/progress.h"
#include "shared/geometry/camera_model.h"
#include "shared/vision/features.h"

namespace lararium::train {

struct VerificationOptions {
  float ratio = 0.8f;
  double threshold_px = 2.0;  // Largest epipolar distance of an inlier.
  double band_px = 4.0;       // Half width of the guided search along epipolar lines.
  size_t min_matches = 20;
  // Pairs with a larger index difference are first tried with their strongest features only.
  uint32_t trusted_gap = 8;
};

struct VerifiedPairs {
  std::vector<VerifiedPair> pairs;      // Ordered as the candidates.
  std::vector<TrainingCamera> cameras;  // The mapping begins with their intrinsics.
  // Images of a film whose index differs by no more than this follow one another and overlap. None
  // if the images are unordered.
  std::optional<uint32_t> film_gap = std::nullopt;
};

// The images and the cameras that took them; camera_of_image[image] is an index into cameras.
struct CameraImages {
  std::span<const vision::Features> features;
  std::span<const TrainingCamera> cameras;
  std::span<const uint32_t> camera_of_image;
};

// Verifies pairs. If the intrinsics of all cameras are given, this is done by essential matrices.
// Otherwise it is done by fundamental matrices; a focal length that is not known is then the one
// that the matrices agree on, as a share of the image's longer side, otherwise 1.2 times that side,
// or 0.8 times if there are several cameras.
// Principal points are those of the models. The poses are computed with these intrinsics.
VerifiedPairs VerifyPairs(const CameraImages& images,
                          std::span<const ImagePair> candidates,
                          const VerificationOptions& options,
                          Progress& progress);

}  // namespace lararium::train
