#pragma once

// Reference images. For a .larhuman: the person in a probe's light, path-traced or lit like in the
// player, from one camera and in linear radiance, so that both can be compared. For a project: a
// moment of its show, both methods side by side (scene_reference.h).

#include "editor/text/command_result.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct ReferenceOptions {
  std::filesystem::path human;  // A .larhuman that stands at the stage's origin, or a project.
  std::string place;            // A place of the project; empty: its only one.
  // A recording of the place that has the frame; empty: no camera image.
  std::filesystem::path video;
  // An HDR image. For a project: empty, the probe of the place is used.
  std::filesystem::path probe;
  double probe_turn = 0.0;  // Degrees about the vertical, stage from probe.
  double probe_scale = 1.0;
  std::filesystem::path camera;  // poses.json; its world frame is the stage.
  int frame = 0;                 // The frame of the camera file, or of the video.
  std::string clip;              // Empty: the rest pose.
  double time = 0.0;             // Seconds into the clip, or, for a project, into the drama.
  std::optional<double> ground;  // Albedo of a floor of 4 x 4 m; not set: no floor.
  bool without_person = false;   // Shows only the floor.
  std::string method = "path";   // One of path, prt, sh, phong.
  int samples = 256;             // Per pixel, for path.
  int bounces = 4;
  uint64_t seed = 1;
  std::filesystem::path out;  // A file .exr; for a project .png or .jpg.
};

Result<CommandResult> RunReference(const ReferenceOptions& options, Progress& progress, Log& log);

}  // namespace lararium::editor
