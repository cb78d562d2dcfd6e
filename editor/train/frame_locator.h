#pragma once

// Describes how the frames of the source relate to the finished map: both the keyframes, and the
// other frames, which are located in it.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "editor/train/reconstruction.h"
#include "shared/geometry/frame.h"
#include "shared/vision/localizer.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// The map as seen by one image.
struct LocatedView {
  std::optional<geometry::Rigid3> camera_from_map;
  int features = 0;
  int observations = 0;  // Number of observed map points.
  double median_error_px = 0.0;
  // The camera that took it: the given one or, if that was a guess, the estimate.
  geometry::CameraModel camera = {};
};

// Describes an image of the reconstruction; leaves LocatedView::features 0.
LocatedView DescribeImage(const Reconstruction& reconstruction, uint32_t image);

struct FrameToLocate {
  const geometry::Frame* frame = nullptr;
  // The camera that took it. CameraGuess::predicted is where it probably was, for images that do
  // not say which of several parts that look alike they show.
  vision::CameraGuess camera;
  // How the camera moved in the frame, zero if it is not known; it matters if the shutter rolls.
  ImageMotion motion = ImageMotion::Zero();
};

// Locates images in a map by vision::Localizer. The time per image hardly depends on the size of
// the map or the number of its keyframes.
class FrameLocator {
 public:
  // The database must outlive this.
  explicit FrameLocator(const vision::SceneDatabase& database);
  ~FrameLocator();

  // Result i describes frames[i]. Uses all cores. Deterministic: the same frame gives the same
  // view, independent of earlier calls.
  std::vector<LocatedView> Locate(std::span<const FrameToLocate> frames);

 private:
  class Worker;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace lararium::train
