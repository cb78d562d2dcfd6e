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

// That it is none, where so. name: for errors.
Status CheckIsCamera(const std::string& name, VideoDevice& device);

Result<CameraMode> SetUpCamera(const std::string& name,
                               const CameraSettings& settings,
                               VideoDevice& device,
                               FrameConverter& converter);

}  // namespace lararium::capture
