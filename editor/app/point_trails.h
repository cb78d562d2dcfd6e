#pragma once

// Where the points that poses stand on were seen in the frames up to now.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/vision/tracked_frame.h"

namespace lararium::app {

struct PointTrail {
  uint32_t point = 0;                   // of the map
  std::vector<Eigen::Vector2f> pixels;  // newest first, one for each frame in a row
};

class PointTrails {
 public:
  static constexpr size_t kLongest = 12;  // frames

  // The next frame. A frame that does not follow the one before, or another map, begins anew.
  void Add(int64_t frame, uint32_t map, std::span<const vision::SeenPoint> seen);

  // One for each point of the last frame, by point.
  const std::vector<PointTrail>& trails() const { return trails_; }

 private:
  int64_t frame_ = -1;
  uint32_t map_ = 0;
  std::vector<PointTrail> trails_;
};

}  // namespace lararium::app
