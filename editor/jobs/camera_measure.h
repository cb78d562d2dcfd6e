#pragma once

// Measurement of a camera's noise, sharpness and response from a recording.

#include <filesystem>
#include <span>

#include "editor/document/project.h"
#include "editor/text/command_result.h"
#include "shared/capture/camera_list.h"
#include "shared/capture/frame_source.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/light/camera_response.h"
#include "shared/light/camera_traits.h"

namespace lararium::editor {

struct CameraOptions {
  bool list = false;              // Only list the connected cameras.
  std::filesystem::path project;  // Required unless list is set.
  std::string place;              // Empty: the only place of the project.
  // At most one of video and images is set. Neither: the training recording.
  std::filesystem::path video;
  std::filesystem::path images;
  std::filesystem::path response;
  std::optional<double> knee;     // Not set: the knee is fitted to the response.
  std::optional<double> shutter;  // Share of the time between frames; not set: estimated.
  std::filesystem::path device_out;
  bool forget = false;
};

// Measures noise and sharpness on frames from the whole recording. The sharpest quarter of them
// determines the sharpness, because the others have motion blur. Noise that cannot be separated
// from the image is reported as 0. A recording does not show response and shutter; they keep their
// defaults. Fails where a frame cannot be read or no frame has edges.
Result<light::CameraTraits> MeasureCamera(capture::FrameSource& source, Progress& progress);

// Measures the recording that a place was trained from, and keeps the known response and shutter.
Result<light::CameraTraits> MeasureCamera(const ProjectPaths& paths,
                                          const PlaceDocument& place,
                                          Progress& progress);

Result<light::CameraResponse> LoadCameraResponse(const std::filesystem::path& file);

// One line of text.
std::string CameraText(const light::CameraTraits& traits);

// One line of text for each camera, and JSON: {"cameras": [{"number", "name"}, ...]}. A camera that
// cannot be queried has "problem" instead of "name".
CommandResult CameraList(std::span<const capture::ConnectedCamera> cameras);

Result<CommandResult> RunCamera(const CameraOptions& options, Progress& progress);

}  // namespace lararium::editor
