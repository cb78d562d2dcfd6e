#pragma once

// A show of one actor with one joint, and fakes of its frame and pose sources.

#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/show/show.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::test {

// Actor "one" walks along +X at 1 m/s from the origin and then stops.
show::ShowContent SmallContent();

// Delivers `count` frames at 30 per second; fails at frame fail_at unless it is negative.
class FakeSource : public capture::FrameSource {
 public:
  explicit FakeSource(int64_t count, int64_t fail_at = -1) : count_(count), fail_at_(fail_at) {}

  Result<std::optional<geometry::Frame>> Next() override;
  Status Seek(int64_t index) override;
  std::optional<int64_t> frame_count() const override { return count_; }
  int width() const override { return 64; }
  int height() const override { return 48; }
  double frames_per_second() const override { return 30.0; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return std::to_string(index); }

 private:
  int64_t count_;
  int64_t fail_at_;
  int64_t next_ = 0;
};

// Gives a pose for every frame except those whose index is a multiple of lost_every.
class FakePoses : public vision::PoseSource {
 public:
  explicit FakePoses(int64_t lost_every = 0) : lost_every_(lost_every) {}

  vision::TrackedFrame Track(const geometry::Frame& frame) override;
  const std::vector<int64_t>& seen() const { return seen_; }

 private:
  int64_t lost_every_;
  std::vector<int64_t> seen_;
};

}  // namespace lararium::test
