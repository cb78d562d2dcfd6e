#pragma once

// The image positions, in the last frames, of the map points that determine the pose.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/vision/tracked_frame.h"

namespace lararium::editor {

struct PointTrail {
  uint32_t point = 0;                   // Index of a point in the map.
  std::vector<Eigen::Vector2f> pixels;  // Newest first, one for each consecutive frame.
};

class PointTrails {
 public:
  static constexpr size_t kLongest = 12;  // Frames.

  // Adds the next frame. Starts again where the frame does not follow the one before, or where the
  // map is another one.
  void Add(int64_t frame, uint32_t map, std::span<const vision::SeenPoint> seen);

  // One for each point of the last frame, sorted by point.
  const std::vector<PointTrail>& trails() const { return trails_; }

 private:
  int64_t frame_ = -1;
  uint32_t map_ = 0;
  std::vector<PointTrail> trails_;
};

}  // namespace lararium::editor
