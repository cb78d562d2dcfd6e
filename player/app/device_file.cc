#include "player/app/device_file.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::player {
namespace {

using geometry::CameraModel;

constexpr uint64_t kMaxDeviceBytes = 1 << 20;

Result<CameraModel> ParseCamera(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const int64_t width, view.Integer("width", 16, 16384));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t height, view.Integer("height", 16, 16384));
  LARARIUM_ASSIGN_OR_RETURN(std::vector<double> numbers, view.Numbers("K", 4));
  if (view.Has("k1_k2_p1_p2")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> distortion, view.Numbers("k1_k2_p1_p2", 4));
    numbers.insert(numbers.end(), distortion.begin(), distortion.end());
  }
  const Result<CameraModel> camera =
      CameraModel::FromNumbers(numbers, static_cast<int>(width), static_cast<int>(height));
  return camera.ok() ? camera : camera.status().At(view.place());
}

Result<capture::CameraSettings> ParseCapture(const JsonView& view) {
  capture::CameraSettings settings;
  if (view.Has("format")) {
    LARARIUM_ASSIGN_OR_RETURN(settings.format, view.Text("format", 4));
    if (settings.format.size() != 4) {
      return view.Problem("\"format\" must have four letters", "as MJPG or YUYV");
    }
  }
  if (view.Has("width") || view.Has("height")) {
    LARARIUM_ASSIGN_OR_RETURN(const int64_t width, view.Integer("width", 16, 16384));
    LARARIUM_ASSIGN_OR_RETURN(const int64_t height, view.Integer("height", 16, 16384));
    settings.width = static_cast<int>(width);
    settings.height = static_cast<int>(height);
  }
  if (view.Has("frames_per_second")) {
    LARARIUM_ASSIGN_OR_RETURN(settings.frames_per_second,
                              view.Number("frames_per_second", 1.0, 1000.0));
  }
  if (view.Has("exposure_ms")) {
    LARARIUM_ASSIGN_OR_RETURN(settings.exposure_ms, view.Number("exposure_ms", 0.01, 1000.0));
  }
  return settings;
}

Result<show::TrackingLossFaderOptions> ParseLost(const JsonView& view) {
  show::TrackingLossFaderOptions lost;
  const std::pair<const char*, double*> fields[] = {{"hold", &lost.hold},
                                                    {"fade", &lost.fade},
                                                    {"appear", &lost.appear},
                                                    {"guide_after", &lost.guide_after}};
  for (const auto& [name, seconds] : fields) {
    if (view.Has(name)) {
      LARARIUM_ASSIGN_OR_RETURN(*seconds, view.Number(name, 0.0, 60.0));
    }
  }
  return lost;
}

}  // namespace

Result<Device> LoadDevice(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxDeviceBytes));
  return ParseDevice(text, file.string());
}

Result<Device> ParseDevice(std::string_view text, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, where));
  const JsonView view(json, where);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t schema, view.Integer("schema", 1, 1'000'000));
  if (schema != 1) {
    return view.Problem("was written for a newer player", "update the player");
  }
  Device device;
  if (view.Has("camera")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView camera, view.Field("camera"));
    LARARIUM_ASSIGN_OR_RETURN(device.camera, ParseCamera(camera));
  }
  if (view.Has("look")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView look, view.Field("look"));
    LARARIUM_ASSIGN_OR_RETURN(device.look,
                              ParseFields<light::CameraTraits>(look, UnknownFields::kIgnore));
  }
  if (view.Has("capture")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView capture, view.Field("capture"));
    LARARIUM_ASSIGN_OR_RETURN(device.capture, ParseCapture(capture));
  }
  if (view.Has("lost")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView lost, view.Field("lost"));
    LARARIUM_ASSIGN_OR_RETURN(device.lost, ParseLost(lost));
  }
  if (view.Has("headset")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView headset, view.Field("headset"));
    LARARIUM_ASSIGN_OR_RETURN(device.headset, ParseHeadset(headset));
  }
  if (view.Has("buttons")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView buttons, view.Field("buttons"));
    LARARIUM_ASSIGN_OR_RETURN(device.buttons, ParseButtons(buttons));
  }
  constexpr std::array<std::string_view, 6> kFields = {"buttons", "camera", "capture",
                                                       "headset", "look",   "lost"};
  if (std::none_of(kFields.begin(), kFields.end(), [&](auto field) { return view.Has(field); })) {
    return view.Problem(
        "has none of \"buttons\", \"camera\", \"capture\", \"headset\", \"look\", \"lost\"",
        "docs/file-formats.md says what they hold");
  }
  return device;
}

}  // namespace lararium::player
