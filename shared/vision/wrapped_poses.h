#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

// A source that changes the frames of another one and passes everything else on to it. Private to
// vision.
class WrappedPoses : public PoseSource {
 public:
  explicit WrappedPoses(std::unique_ptr<PoseSource> poses) : poses_(std::move(poses)) {}

  TrackedFrame Track(const geometry::Frame& frame) override {
    TrackedFrame tracked = poses_->Track(frame);
    Apply(tracked);
    return tracked;
  }
  void Relocalize() override { poses_->Relocalize(); }
  void Seen(std::vector<SeenPoint>& seen) const override { poses_->Seen(seen); }
  void SetOccluders(uint32_t map, std::span<const OccluderMesh> meshes) override {
    poses_->SetOccluders(map, meshes);
  }

 private:
  virtual void Apply(TrackedFrame& tracked) = 0;

  std::unique_ptr<PoseSource> poses_;
};

}  // namespace lararium::vision
