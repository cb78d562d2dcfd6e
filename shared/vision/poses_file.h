#pragma once

// The file poses.json with the poses of images, written by training and by the player's option
// --poses-out. The world frame is the map frame.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

// The tracker's details about a frame; see TrackedFrame.
struct TrackingDetails {
  TrackState state = TrackState::kSearching;
  TrackReason reason = TrackReason::kNone;
  uint32_t map = 0;
  bool followed = false;
  float confidence = 0.0f;
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};
};

struct PoseRecord {
  std::string file;  // Name of the image, see FrameSource::FrameName.
  geometry::CameraModel camera;
  std::optional<geometry::Rigid3> camera_from_world;
  bool tracked = false;  // If false, the pose is a guess and must not be used.
  std::optional<RollingShutter> shutter = std::nullopt;   // Absent if it is global or unknown.
  std::optional<TrackingDetails> details = std::nullopt;  // Absent in files written by training.
};

PoseRecord MakePoseRecord(std::string file, const TrackedFrame& tracked);

Status SavePoses(const std::filesystem::path& path, const std::vector<PoseRecord>& poses);
// Reads the details except state and reason.
Result<std::vector<PoseRecord>> LoadPoses(const std::filesystem::path& path);

}  // namespace lararium::vision
