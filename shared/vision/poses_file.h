#pragma once

// poses.json: the poses of images, as training and the player write them with
// --poses-out. The world is the map.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

// What a tracker says about a frame besides its pose: see TrackedFrame.
struct TrackingDetails {
  TrackState state = TrackState::kSearching;
  TrackReason reason = TrackReason::kNone;
  uint32_t map = 0;
  bool followed = false;
  float confidence = 0.0f;
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};
};

struct PoseRecord {
  std::string file;  // FrameSource::FrameName of the image
  geometry::CameraModel camera;
  std::optional<geometry::Rigid3> camera_from_world;
  bool tracked = false;  // a pose that was not tracked is a guess, and not used
  std::optional<TrackingDetails> details = std::nullopt;  // training writes none
};

PoseRecord MakePoseRecord(std::string file, const TrackedFrame& tracked);

Status SavePoses(const std::filesystem::path& path, std::span<const PoseRecord> poses);
// Of the details all but state and reason are read back.
Result<std::vector<PoseRecord>> LoadPoses(const std::filesystem::path& path);

}  // namespace lararium::vision
