#pragma once

// What a camera's images are like, measured on a recording.

#include <filesystem>
#include <span>

#include "editor/app/options.h"
#include "editor/app/project.h"
#include "editor/app/subcommands.h"
#include "shared/capture/camera_list.h"
#include "shared/capture/frame_source.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/light/camera_response.h"
#include "shared/light/camera_traits.h"

namespace lararium::app {

// Noise and sharpness from frames all over the recording: the sharpest quarter of them says
// how sharp it is, since others are smeared by motion. Noise that cannot be told from the
// image is none. Response and shutter cannot be seen in a recording and are left as they are.
// Fails where a frame cannot be read or no frame has edges.
Result<light::CameraTraits> MeasureCamera(capture::FrameSource& source, Progress& progress);

// The same from the recording that a place was trained from; what is known of response
// and shutter is kept.
Result<light::CameraTraits> MeasureCamera(const ProjectPaths& paths,
                                          const PlaceDocument& place,
                                          Progress& progress);

Result<light::CameraResponse> LoadCameraResponse(const std::filesystem::path& file);

// A line for people.
std::string CameraText(const light::CameraTraits& traits);

// A line for each, and the same for programs: {"cameras": [{"number", "name"}, ...]}, with
// "problem" in place of the name of one that cannot be asked.
CommandResult CameraList(std::span<const capture::ConnectedCamera> cameras);

Result<CommandResult> RunCamera(const CameraOptions& options, Progress& progress);

}  // namespace lararium::app
