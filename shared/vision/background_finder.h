#pragma once

// Finds a frame beside the others, in a thread of its own or in the caller's when
// the answer is wanted.

#include <condition_variable>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stop_token>
#include <thread>

#include "shared/geometry/camera_model.h"
#include "shared/vision/finder.h"

namespace lararium::vision {

// For one thread. The finder is that thread's own while this is not busy: what it works with takes
// megabytes.
class BackgroundFinder {
 public:
  // The finder must outlive this. threads: 1: no thread of its own.
  BackgroundFinder(Finder& finder, int threads);

  // !busy(). The pixels are shared, never copied.
  void Begin(const cv::Mat& grey, const geometry::CameraModel& camera);
  bool busy() const { return busy_; }

  // busy(). The answer, after which it is not busy any more; nullopt where it is not
  // ready and wait is false.
  std::optional<Located> Take(bool wait);
  // Not busy any more, whatever the answer is.
  void Drop();

 private:
  void Work(const std::stop_token& stop);
  void EndLocked();

  Finder& finder_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  cv::Mat grey_;
  geometry::CameraModel camera_;
  std::optional<Located> located_;
  bool busy_ = false;    // changed by the caller only
  std::jthread thread_;  // last: stops before what it uses goes
};

}  // namespace lararium::vision
