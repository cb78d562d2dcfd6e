#pragma once

// A moment of a show, path-traced and as the renderer draws it, side by side with the difference.
// The drama poses the people, their cloth has settled, and props are included. Real surfaces (the
// place's occluders) receive shadows by differential rendering (Debevec, SIGGRAPH 1998): they are
// traced with and without the virtual objects, as matte surfaces of the one albedo that explains
// the camera's image best, and the image is multiplied by the ratio.

#include "editor/jobs/reference.h"
#include "editor/text/command_result.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::editor {

// The camera of a reference picture.
struct ReferenceView {
  geometry::CameraModel pinhole;
  geometry::Rigid3 camera_from_stage;
};

// Reads frame options.frame of options.camera.
Result<ReferenceView> LoadReferenceView(const ReferenceOptions& options);

// Bakes stale products first.
Result<CommandResult> RunSceneReference(const ReferenceOptions& options,
                                        Progress& progress,
                                        Log& log);

}  // namespace lararium::editor
