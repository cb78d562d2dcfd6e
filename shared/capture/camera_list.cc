#include "shared/capture/camera_list.h"

#include <filesystem>
#include <system_error>

#include "shared/capture/camera_setup.h"
#include "shared/capture/camera_source.h"
#include "shared/core/file.h"

namespace lararium::capture {
namespace {

constexpr int kMostDevices = 256;  // number of device numbers in Linux

std::optional<Result<std::unique_ptr<VideoDevice>>> OpenIfThere(int number) {
  if (!FileExists(VideoDeviceFile(number))) {
    return std::nullopt;
  }
  return OpenVideoDevice("camera " + std::to_string(number), number);
}

}  // namespace

std::vector<ConnectedCamera> ListCameras(const DeviceOpener& open) {
  std::vector<ConnectedCamera> cameras;
  for (int number = 0; number < kMostDevices; ++number) {
    const auto device = open(number);
    if (!device) {
      continue;
    }
    if (!device->ok()) {
      cameras.push_back({number, "", device->message()});
      continue;
    }
    const Result<std::string> name = CameraName("camera " + std::to_string(number), ***device);
    if (name.ok()) {
      cameras.push_back({number, *name, ""});
    }
  }
  return cameras;
}

std::vector<ConnectedCamera> ConnectedCameras() { return ListCameras(OpenIfThere); }

}  // namespace lararium::capture
