#pragma once

// Locates one frame without a prior while later frames are tracked.

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "shared/vision/localizer.h"
#include "shared/vision/map_locator.h"

namespace lararium::vision {

class Relocalizer;

// Not thread-safe: all calls must come from one thread.
class BackgroundSearch {
 public:
  virtual ~BackgroundSearch() = default;

  // Starts to locate an image. Requires !busy(). The pixels are shared, not copied.
  virtual void Begin(const cv::Mat& grey, const CameraGuess& guess) = 0;
  virtual bool busy() const = 0;
  // Returns the result and ends the busy state. Requires busy(). nullopt if the result is not ready
  // and wait is false.
  virtual std::optional<Located> Take(bool wait) = 0;
  // Discards the result, waiting for running work to finish. Not busy afterwards.
  virtual void Drop() = 0;
  // The points that support the pose that was last taken, as Localizer::points().
  virtual std::span<const LocatedPoint> points() const = 0;
};

// The search of this program, which uses the relocaliser while it is busy. The relocaliser must
// outlive it; sharing it with the tracker saves megabytes of working memory. threads == 1: no
// thread is started, and Take() does the work.
std::unique_ptr<BackgroundSearch> MakeBackgroundSearch(Relocalizer& relocalizer, int threads);

}  // namespace lararium::vision
