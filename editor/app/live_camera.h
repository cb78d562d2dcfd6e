#pragma once

// A live camera in the camera view, in place of a recording.

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "shared/capture/frame_source.h"
#include "shared/capture/steady_camera.h"
#include "shared/core/status.h"

namespace lararium::app {

// Whether the camera is there: it may be unplugged, and comes back by itself. From any thread.
using CameraPresence = std::atomic<bool>;

// The camera of a number; or a recording, which comes at its own pace as if it were one, over and
// over.
Result<std::unique_ptr<capture::FrameSource>> OpenLiveCamera(
    const std::string& camera, std::shared_ptr<CameraPresence> presence);

// What may be unplugged. open: of the camera; an error where it is not there at first.
Result<std::unique_ptr<capture::FrameSource>> OpenSteadily(
    const std::function<Result<std::unique_ptr<capture::FrameSource>>()>& open,
    std::shared_ptr<CameraPresence> presence);

}  // namespace lararium::app
