#pragma once

#include <condition_variable>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stop_token>
#include <thread>

#include "shared/vision/background/background_search.h"
#include "shared/vision/relocalizer.h"

namespace lararium::vision {

// Locates the frame in a thread of its own. While this is not busy, the caller's thread may use the
// relocaliser itself.
class BackgroundRelocalizer final : public BackgroundSearch {
 public:
  // The relocaliser must outlive this.
  explicit BackgroundRelocalizer(Relocalizer& relocalizer);

  void Begin(const cv::Mat& grey, const CameraGuess& guess) override;
  bool busy() const override { return busy_; }
  std::optional<Located> Take(bool wait) override;
  void Drop() override;
  std::span<const LocatedPoint> points() const override { return relocalizer_.points(map_); }

 private:
  void Work(const std::stop_token& stop);
  void EndLocked();

  Relocalizer& relocalizer_;
  uint32_t map_ = 0;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  cv::Mat grey_;
  CameraGuess guess_;
  std::optional<Located> located_;
  bool busy_ = false;    // Changed by the caller's thread only.
  std::jthread thread_;  // Last member, so that it stops before the members it uses are destroyed.
};

}  // namespace lararium::vision
