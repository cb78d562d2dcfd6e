#include "player/camera_choice.h"

#include "shared/core/json.h"

namespace lararium::player {
namespace {

using geometry::CameraModel;

// {"schema": 1, "camera": {"width", "height", "K": [fx, fy, cx, cy],
// "k1_k2_p1_p2": [...]}}
Result<CameraModel> LoadDeviceCamera(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  const JsonView view(json, file.string());
  LARARIUM_ASSIGN_OR_RETURN(const int64_t schema, view.Integer("schema", 1, 1'000'000));
  if (schema != 1) {
    return view.Problem("was written for a newer player", "update the player");
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView camera, view.Field("camera"));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t width, camera.Integer("width", 16, 16384));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t height, camera.Integer("height", 16, 16384));
  LARARIUM_ASSIGN_OR_RETURN(std::vector<double> numbers, camera.Numbers("K", 4));
  if (camera.Has("k1_k2_p1_p2")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> distortion,
                              camera.Numbers("k1_k2_p1_p2", 4));
    numbers.insert(numbers.end(), distortion.begin(), distortion.end());
  }
  return CameraModel::FromNumbers(numbers, static_cast<int>(width), static_cast<int>(height));
}

}  // namespace

Result<CameraChoice> ChooseCamera(const PlayOptions& options,
                                  const CameraModel& trained,
                                  int width,
                                  int height) {
  CameraChoice choice{{}, "the bundle"};
  Result<CameraModel> camera = trained;
  if (!options.intrinsics.empty()) {
    choice.origin = "--intrinsics";
    camera = CameraModel::FromNumbers(options.intrinsics, width, height);
  } else if (!options.device.empty()) {
    choice.origin = options.device.string();
    camera = LoadDeviceCamera(options.device);
  }
  if (camera.ok()) {
    camera = camera->ForImages(width, height);
  }
  if (!camera.ok()) {
    // What the device file says wrong names the file already.
    const bool named = camera.message().starts_with(choice.origin);
    return named ? camera.status() : camera.status().At(choice.origin);
  }
  choice.camera = *camera;
  return choice;
}

}  // namespace lararium::player
