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

Result<CameraChoice> ChooseTrained(std::span<const TrainedCamera> trained, int width, int height) {
  Status problem;
  for (const TrainedCamera& candidate : trained) {
    const std::string origin = "the bundle's place \"" + candidate.place + "\"";
    const Result<CameraModel> camera = candidate.camera.ForImages(width, height);
    if (camera.ok()) {
      return CameraChoice{*camera, origin};
    }
    if (problem.ok()) {
      problem = camera.status().At(origin);
    }
  }
  return problem;
}

}  // namespace

Result<CameraChoice> ChooseCamera(const PlayOptions& options,
                                  std::span<const TrainedCamera> trained,
                                  int width,
                                  int height) {
  if (options.intrinsics.empty() && options.device.empty()) {
    return ChooseTrained(trained, width, height);
  }
  const bool by_option = !options.intrinsics.empty();
  const std::string origin = by_option ? "--intrinsics" : options.device.string();
  Result<CameraModel> camera = by_option
                                   ? CameraModel::FromNumbers(options.intrinsics, width, height)
                                   : LoadDeviceCamera(options.device);
  if (camera.ok()) {
    camera = camera->ForImages(width, height);
  }
  if (!camera.ok()) {
    // What the device file says wrong names the file already.
    const bool named = camera.message().starts_with(origin);
    return named ? camera.status() : camera.status().At(origin);
  }
  return CameraChoice{*camera, origin};
}

}  // namespace lararium::player
