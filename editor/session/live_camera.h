#pragma once

// A live camera for the camera view, instead of a recording.

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "shared/capture/frame_source.h"
#include "shared/capture/steady_camera.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Whether the camera is connected. It can be unplugged, and works again after it is plugged in.
// Thread-safe.
using CameraPresence = std::atomic<bool>;

// Opens the camera with a number, or a recording that is played like a camera, in a loop.
Result<std::unique_ptr<capture::FrameSource>> OpenLiveCamera(
    const std::string& camera, std::shared_ptr<CameraPresence> presence);

// Wraps a camera that can be unplugged. open: opens the camera. Fails where it is not connected at
// first.
Result<std::unique_ptr<capture::FrameSource>> OpenSteadily(
    const std::function<Result<std::unique_ptr<capture::FrameSource>>()>& open,
    std::shared_ptr<CameraPresence> presence);

}  // namespace lararium::editor
