#include "player/app/camera_choice.h"

#include "player/app/device_file.h"

namespace lararium::player {
namespace {

using geometry::CameraModel;

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

Result<CameraChoice> ChooseCamera(const CameraOptions& options,
                                  std::span<const TrainedCamera> trained,
                                  int width,
                                  int height) {
  const bool by_option = !options.intrinsics.empty();
  Device device;
  if (!by_option && !options.device.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(device, LoadDevice(options.device));
  }
  if (!by_option && !device.camera) {
    return ChooseTrained(trained, width, height);
  }
  const std::string origin = by_option ? "--intrinsics" : options.device.string();
  Result<CameraModel> camera = by_option
                                   ? CameraModel::FromNumbers(options.intrinsics, width, height)
                                   : Result<CameraModel>(*device.camera);
  if (camera.ok()) {
    camera = camera->ForImages(width, height);
  }
  if (!camera.ok()) {
    return camera.status().At(origin);
  }
  return CameraChoice{*camera, origin};
}

}  // namespace lararium::player
