#pragma once

// Finds a frame beside the others, in a thread of its own or in the caller's when
// the answer is wanted.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>

#include "shared/geometry/camera_model.h"
#include "shared/vision/finder.h"

namespace lararium::vision {

// Begin, busy and Take are for one thread.
class BackgroundFinder {
 public:
  // threads of the options, 1: no thread of its own.
  BackgroundFinder(std::span<const std::shared_ptr<const SceneDatabase>> maps,
                   const TrackerOptions& options);

  // !busy(). The pixels are shared, never copied.
  void Begin(const cv::Mat& grey, const geometry::CameraModel& camera);
  bool busy() const { return busy_; }

  // busy(). The answer, after which it is not busy any more; nullopt where it is not
  // ready and wait is false.
  std::optional<Located> Take(bool wait);

  // !busy(). Localizer::points of the answer that was taken last, found in this map.
  std::span<const LocatedPoint> points(uint32_t map) const { return finder_.points(map); }

 private:
  void Work(const std::stop_token& stop);

  Finder finder_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  cv::Mat grey_;
  geometry::CameraModel camera_;
  std::optional<Located> located_;
  bool busy_ = false;    // changed by the caller only
  std::jthread thread_;  // last: stops before what it uses goes
};

}  // namespace lararium::vision
