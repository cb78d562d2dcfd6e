#pragma once

// What the player knows of the camera and the headset that it runs on (docs/file-formats.md).

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "player/headset.h"
#include "player/visitor_actions.h"
#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/light/camera_traits.h"
#include "shared/show/lost_ladder.h"

namespace lararium::player {

// What is missing is taken from the bundle.
struct Device {
  std::optional<geometry::CameraModel> camera;  // its calibration
  std::optional<light::CameraTraits> look;      // how noisy and soft its images are
  capture::CameraSettings capture;              // how it is run
  std::optional<Headset> headset;               // through which visitors see
  Buttons buttons;                              // that they press
  show::LostLadderOptions lost;                 // what happens while tracking is lost, and when
};

Result<Device> LoadDevice(const std::filesystem::path& file);
// place: what errors call the text.
Result<Device> ParseDevice(std::string_view text, const std::string& place);

}  // namespace lararium::player
