#pragma once

// Finds images without a prior: features, as finely as the image needs, then the
// search among the maps.

#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "shared/geometry/camera_model.h"
#include "shared/vision/features.h"
#include "shared/vision/level_of_detail.h"
#include "shared/vision/map_locator.h"
#include "shared/vision/tracker.h"

namespace lararium::vision {

class Finder {
 public:
  // At least one map; shares them.
  Finder(std::span<const std::shared_ptr<const SceneDatabase>> maps, const TrackerOptions& options);

  // The level of detail may save work but never cost a pose: where it fails, the
  // finest level has the last word on the same frame. grey: CV_8UC1.
  Located Find(const cv::Mat& grey, const geometry::CameraModel& camera);

  // Of the last image, which was found in this map.
  std::span<const LocatedPoint> points(uint32_t map) const { return locator_.points(map); }
  // Of the last image.
  int features() const { return static_cast<int>(features_.size()); }

 private:
  Located Locate(const cv::Mat& grey,
                 const geometry::CameraModel& camera,
                 const FeatureOptions& options);

  MapLocator locator_;
  FeatureExtractor extractor_;
  Features features_;
  LevelOfDetail detail_;
};

}  // namespace lararium::vision
