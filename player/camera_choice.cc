#include "player/camera_choice.h"

#include <cmath>

#include "shared/core/json.h"

namespace lararium::player {
namespace {

using geometry::CameraModel;

CameraModel CameraFromNumbers(const std::vector<double>& n, int width, int height) {
  CameraModel camera{width, height, n[0], n[1], n[2], n[3]};
  if (n.size() == 8) {
    camera.k1 = n[4];
    camera.k2 = n[5];
    camera.p1 = n[6];
    camera.p2 = n[7];
  }
  return camera;
}

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
  return CameraFromNumbers(numbers, static_cast<int>(width), static_cast<int>(height));
}

// The camera for images of another size of the same aspect.
Result<CameraModel> ForSize(const CameraModel& camera,
                            int width,
                            int height,
                            const std::string& origin) {
  if (camera.width == width && camera.height == height) {
    return camera;
  }
  const double wanted = static_cast<double>(camera.width) * height / camera.height;
  if (std::abs(wanted - width) > 1.0) {
    return Status::Error(origin,
                         "was made for images of " + std::to_string(camera.width) + "x" +
                             std::to_string(camera.height) + ", these are " +
                             std::to_string(width) + "x" + std::to_string(height),
                         "give --intrinsics for this camera");
  }
  return camera.Resized(width, height);
}

}  // namespace

Result<CameraChoice> ChooseCamera(const PlayOptions& options,
                                  const CameraModel& trained,
                                  int width,
                                  int height) {
  CameraChoice choice;
  if (!options.intrinsics.empty()) {
    choice = {CameraFromNumbers(options.intrinsics, width, height), "--intrinsics"};
  } else {
    CameraModel calibrated = trained;
    choice.origin = "the bundle";
    if (!options.device.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(calibrated, LoadDeviceCamera(options.device));
      choice.origin = options.device.string();
    }
    LARARIUM_ASSIGN_OR_RETURN(choice.camera, ForSize(calibrated, width, height, choice.origin));
  }
  if (const Status valid = choice.camera.Validate(); !valid.ok()) {
    return valid.At(choice.origin);
  }
  return choice;
}

}  // namespace lararium::player
