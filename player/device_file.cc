#include "player/device_file.h"

#include <vector>

#include "shared/core/json.h"

namespace lararium::player {
namespace {

using geometry::CameraModel;

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

}  // namespace

Result<Device> LoadDevice(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  const JsonView view(json, file.string());
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
    LARARIUM_ASSIGN_OR_RETURN(device.look, light::ParseCameraTraits(look));
  }
  if (!device.camera && !device.look) {
    return view.Problem("has neither \"camera\" nor \"look\"",
                        "docs/file-formats.md says what they hold");
  }
  return device;
}

}  // namespace lararium::player
