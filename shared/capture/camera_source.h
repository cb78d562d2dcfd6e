#pragma once

// Opens cameras through a given driver, for tests. Private to capture: other code calls
// OpenCamera(number) and ConnectedCameras().

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/capture/camera_list.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_device.h"

namespace lararium::capture {

// `name` is the camera in errors.
Result<std::unique_ptr<FrameSource>> OpenCamera(const std::string& name,
                                                std::unique_ptr<VideoDevice> device,
                                                const CameraSettings& settings);

// Returns the driver with a number; nullopt if there is none.
using DeviceOpener = std::function<std::optional<Result<std::unique_ptr<VideoDevice>>>(int number)>;
// Same as ConnectedCameras() with the given opener.
std::vector<ConnectedCamera> ListCameras(const DeviceOpener& open);

}  // namespace lararium::capture
