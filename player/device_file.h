#pragma once

// What the player knows of the camera that it runs on (docs/file-formats.md).

#include <filesystem>
#include <optional>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/light/camera_traits.h"

namespace lararium::player {

// What is missing is taken from the bundle.
struct Device {
  std::optional<geometry::CameraModel> camera;  // its calibration
  std::optional<light::CameraTraits> look;      // how noisy and soft its images are
};

Result<Device> LoadDevice(const std::filesystem::path& file);

}  // namespace lararium::player
