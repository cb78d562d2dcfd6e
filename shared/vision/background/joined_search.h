#pragma once

#include "shared/vision/background/background_search.h"
#include "shared/vision/relocalizer.h"

namespace lararium::vision {

// Locates the frame in the caller's thread, when the result is taken.
class JoinedSearch final : public BackgroundSearch {
 public:
  explicit JoinedSearch(Relocalizer& relocalizer) : relocalizer_(relocalizer) {}

  void Begin(const cv::Mat& grey, const CameraGuess& guess) override;
  bool busy() const override { return !grey_.empty(); }
  std::optional<Located> Take(bool wait) override;
  void Drop() override { grey_.release(); }
  std::span<const LocatedPoint> points() const override { return relocalizer_.points(map_); }

 private:
  Relocalizer& relocalizer_;
  cv::Mat grey_;  // Empty while not busy.
  CameraGuess guess_;
  uint32_t map_ = 0;
};

}  // namespace lararium::vision
