#pragma once

// Cameras by their drivers, for tests. Private to capture: others call OpenCamera(number).

#include <memory>
#include <string>

#include "shared/capture/frame_source.h"
#include "shared/capture/video_device.h"

namespace lararium::capture {

// name: for errors.
Result<std::unique_ptr<FrameSource>> OpenCamera(const std::string& name,
                                                std::unique_ptr<VideoDevice> device,
                                                const CameraSettings& settings);

}  // namespace lararium::capture
