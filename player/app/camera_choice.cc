#include "player/app/camera_choice.h"

#include "player/app/device_file.h"
#include "shared/geometry/similar_camera.h"

namespace lararium::player {
namespace {

using geometry::CameraModel;

CameraChoice GuessFrom(std::span<const TrainedCamera> trained, int width, int height) {
  const TrainedCamera& similar =
      geometry::FindSimilarCamera(trained, &TrainedCamera::camera, width, height);
  return {similar.camera.GuessForImages(width, height),
          "the bundle's place \"" + similar.place + "\", to begin with", false};
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
    return GuessFrom(trained, width, height);
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
