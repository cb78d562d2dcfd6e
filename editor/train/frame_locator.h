#pragma once

// Locates further frames of the source in the finished map.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/database_builder.h"
#include "editor/train/reconstruction.h"

namespace lararium::train {

// A view of the map by one image.
struct LocatedView {
  std::optional<geometry::Rigid3> camera_from_map;
  int features = 0;
  int observations = 0;  // of points of the map
  double median_error_px = 0.0;
};

// What the reconstruction knows of its own image; features is left 0.
LocatedView DescribeImage(const Reconstruction& reconstruction, uint32_t image);

class FrameLocator {
 public:
  // Borrows reconstruction; images[i] is its image i.
  FrameLocator(const Reconstruction& reconstruction, std::span<const TrainingImage> images);

  // By matches with the keyframes nearest in the source. May run on several threads.
  LocatedView Locate(const cv::Mat& grey, int64_t frame_index) const;

 private:
  // What a keyframe sees of the map.
  struct View {
    int64_t frame_index = -1;
    std::vector<vision::Descriptor> descriptors;
    std::vector<uint32_t> tracks;  // [descriptors]
  };

  const Reconstruction& reconstruction_;
  std::vector<View> views_;  // in order of frame_index
};

}  // namespace lararium::train
