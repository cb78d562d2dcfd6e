#pragma once

// How a camera is set up before its images flow. Private to capture.

#include <linux/videodev2.h>

#include <string>

#include "shared/capture/frame_converter.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_device.h"
#include "shared/core/status.h"

namespace lararium::capture {

struct CameraMode {
  v4l2_format format;  // of its images
  double frames_per_second = 30.0;
};

// What a camera's driver calls it, in printable ASCII; an error where it is no camera. name: for
// errors.
Result<std::string> CameraName(const std::string& name, VideoDevice& device);

Result<CameraMode> SetUpCamera(const std::string& name,
                               const CameraSettings& settings,
                               VideoDevice& device,
                               FrameConverter& converter);

}  // namespace lararium::capture
