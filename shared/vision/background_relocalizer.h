#pragma once

// Relocalises a frame while later frames are tracked. The work runs in its own thread, or in the
// caller's thread when the result is taken.

#include <condition_variable>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stop_token>
#include <thread>

#include "shared/geometry/camera_model.h"
#include "shared/vision/relocalizer.h"

namespace lararium::vision {

// Not thread-safe: all calls must come from one thread. While this is not busy, that thread may use
// the relocaliser itself; sharing it saves megabytes of working memory.
class BackgroundRelocalizer {
 public:
  // The relocaliser must outlive this. threads == 1: no thread is started, and Take() does the
  // work.
  BackgroundRelocalizer(Relocalizer& relocalizer, int threads);

  // Starts to locate an image. Requires !busy(). The pixels are shared, not copied.
  void Begin(const cv::Mat& grey, const CameraGuess& guess);
  bool busy() const { return busy_; }

  // Returns the result and ends the busy state. Requires busy(). nullopt if the result is not ready
  // and wait is false.
  std::optional<Located> Take(bool wait);
  // Discards the result, waiting for running work to finish. Not busy afterwards.
  void Drop();

 private:
  void Work(const std::stop_token& stop);
  void EndLocked();

  Relocalizer& relocalizer_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  cv::Mat grey_;
  CameraGuess guess_;
  std::optional<Located> located_;
  bool busy_ = false;    // Changed by the caller's thread only.
  std::jthread thread_;  // Last member, so that it stops before the members it uses are destroyed.
};

}  // namespace lararium::vision
