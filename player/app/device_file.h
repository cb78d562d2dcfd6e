#pragma once

// The device file: camera and headset that the player runs on (docs/file-formats.md).

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "player/fleet/fleet_options.h"
#include "player/kiosk/visitor_actions.h"
#include "player/openxr/headset.h"
#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/light/camera_traits.h"
#include "shared/show/tracking_loss_fader.h"

namespace lararium::player {

// Missing values are taken from the bundle.
struct Device {
  std::optional<geometry::CameraModel> camera;  // calibration of the camera
  std::optional<light::CameraTraits> look;      // noise and softness of its images
  capture::CameraSettings capture;              // format, size, exposure and so on
  std::optional<Headset> headset;               // the visitors' headset
  Buttons buttons;                              // keys and buttons of visitors
  std::optional<FleetOptions> fleet;            // the fleet that the device belongs to
  show::TrackingLossFaderOptions lost;          // reaction to the loss of tracking
};

Result<Device> LoadDevice(const std::filesystem::path& file);
// where: name of the text in errors.
Result<Device> ParseDevice(std::string_view text, const std::string& where);

}  // namespace lararium::player
