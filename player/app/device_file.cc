#include "player/app/device_file.h"

#include <algorithm>
#include <iterator>

#include "shared/core/file.h"
#include "shared/core/json_fields.h"

namespace lararium::player {
namespace {

constexpr uint64_t kMaxDeviceBytes = 1 << 20;

// These descriptions are only for reading.
void DescribeCapture(Fields& fields, capture::CameraSettings& settings) {
  fields.Text(Optional("format"), settings.format, 4);
  fields.Require(!fields.Has("format") || settings.format.size() == 4,
                 "\"format\" must have four letters", "as MJPG or YUYV");
  if (fields.Has("width") || fields.Has("height")) {
    fields.Integer("width", settings.width, 16, 16384);
    fields.Integer("height", settings.height, 16, 16384);
  }
  fields.Number(Optional("frames_per_second"), settings.frames_per_second, 1.0, 1000.0);
  fields.Number(Optional("exposure_ms"), settings.exposure_ms, 0.01, 1000.0);
}

void DescribeLost(Fields& fields, show::TrackingLossFaderOptions& lost) {
  fields.Number(Optional("hold"), lost.hold, 0.0, 60.0);
  fields.Number(Optional("fade"), lost.fade, 0.0, 60.0);
  fields.Number(Optional("appear"), lost.appear, 0.0, 60.0);
  fields.Number(Optional("guide_after"), lost.guide_after, 0.0, 60.0);
}

void DescribeDevice(Fields& fields, Device& device) {
  fields.Schema(1, "was written for a newer player", "update the player");
  fields.Object("camera", device.camera);
  fields.Object("look", device.look);
  fields.Object(Optional("capture"), device.capture, DescribeCapture);
  fields.Object(Optional("lost"), device.lost, DescribeLost);
  fields.Object("headset", device.headset);
  DescribeButtons(fields, Optional("buttons"), device.buttons);
  fields.Object("fleet", device.fleet);
  constexpr const char* kFields[] = {"buttons", "camera", "capture", "fleet",
                                     "headset", "look",   "lost"};
  fields.Require(std::any_of(std::begin(kFields), std::end(kFields),
                             [&](auto name) { return fields.Has(name); }),
                 "has none of \"buttons\", \"camera\", \"capture\", \"fleet\", \"headset\", "
                 "\"look\", \"lost\"",
                 "docs/file-formats.md says what they hold");
}

}  // namespace

Result<Device> LoadDevice(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxDeviceBytes));
  LARARIUM_ASSIGN_OR_RETURN(Device device, ParseDevice(text, file.string()));
  if (device.fleet) {
    ResolvePaths(file.parent_path(), *device.fleet);
  }
  return device;
}

Result<Device> ParseDevice(std::string_view text, const std::string& where) {
  return ParseFields<Device>(text, where, DescribeDevice, UnknownFields::kIgnore);
}

}  // namespace lararium::player
