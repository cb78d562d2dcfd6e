#pragma once

// Cameras by their drivers, for tests. Private to capture: others call OpenCamera(number)
// and ConnectedCameras().

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/capture/camera_list.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_device.h"

namespace lararium::capture {

// name: for errors.
Result<std::unique_ptr<FrameSource>> OpenCamera(const std::string& name,
                                                std::unique_ptr<VideoDevice> device,
                                                const CameraSettings& settings);

// The driver of a number; nullopt: there is none.
using DeviceOpener = std::function<std::optional<Result<std::unique_ptr<VideoDevice>>>(int number)>;
// As ConnectedCameras().
std::vector<ConnectedCamera> ListCameras(const DeviceOpener& open);

}  // namespace lararium::capture
