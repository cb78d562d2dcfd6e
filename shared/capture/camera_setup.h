#pragma once

// Sets up a camera before its images flow. Private to capture.

#include <linux/videodev2.h>

#include <string>

#include "shared/capture/frame_converter.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_device.h"
#include "shared/core/status.h"

namespace lararium::capture {

struct CameraMode {
  v4l2_format format;  // format of the images
  double frames_per_second = 30.0;
};

// Returns the driver's name of the camera in printable ASCII, or an error if the device is not a
// camera. `name` is the camera in errors.
Result<std::string> CameraName(const std::string& name, VideoDevice& device);

Result<CameraMode> SetUpCamera(const std::string& name,
                               const CameraSettings& settings,
                               VideoDevice& device,
                               FrameConverter& converter);

}  // namespace lararium::capture
