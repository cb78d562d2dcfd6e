#pragma once

// What the finished map knows of the source's frames: of those that shaped it,
// and of the others, which are located in it.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/reconstruction.h"
#include "shared/geometry/frame.h"
#include "shared/vision/scene_database.h"

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

// Locates images in a map by vision::Localizer: the time that an image takes
// hardly grows with the map or with the number of its keyframes.
class FrameLocator {
 public:
  // Borrows the database; the images are its camera's.
  explicit FrameLocator(const vision::SceneDatabase& database);
  ~FrameLocator();

  // views[i] of frames[i]. On all cores; the same frame gives the same view,
  // whatever came before.
  std::vector<LocatedView> Locate(std::span<const geometry::Frame> frames);

 private:
  class Worker;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace lararium::train
