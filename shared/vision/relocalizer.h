#pragma once

// Locates images without a prior: extracts features as finely as the image needs, then searches
// the maps.

#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "shared/geometry/camera_model.h"
#include "shared/vision/feature_scale_controller.h"
#include "shared/vision/features.h"
#include "shared/vision/map_locator.h"
#include "shared/vision/tracker.h"

namespace lararium::vision {

class Relocalizer {
 public:
  // Takes at least one map and shares ownership.
  Relocalizer(std::span<const std::shared_ptr<const SceneDatabase>> maps,
              const TrackerOptions& options);

  // Locates an image (CV_8UC1). A coarse feature scale saves time but must not cost a pose: if it
  // finds none, the same image is tried again at the finest scale.
  Located Find(const cv::Mat& grey, const CameraGuess& guess);

  // The points that support the last pose. map must be the one in which the image was located.
  std::span<const LocatedPoint> points(uint32_t map) const { return locator_.points(map); }
  // Number of features in the last image.
  int features() const { return static_cast<int>(features_.size()); }

 private:
  Located Locate(const cv::Mat& grey, const CameraGuess& guess, const FeatureOptions& options);

  MapLocator locator_;
  FeatureExtractor extractor_;
  Features features_;
  FeatureScaleController detail_;
};

}  // namespace lararium::vision
