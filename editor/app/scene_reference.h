#pragma once

// A moment of a show, path-traced and as the renderer draws it, side by side with their
// difference. People are posed by the drama, their cloth has hung for a while; props are
// there. Real surfaces (the place's occluders) catch shadows by differential rendering
// (Debevec, SIGGRAPH 1998): they are traced with and without what is virtual, as matte
// surfaces of the one albedo that explains the camera's image best, and the image is
// multiplied by the ratio.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::app {

// Where a picture is taken from.
struct ReferenceView {
  geometry::CameraModel pinhole;
  geometry::Rigid3 camera_from_stage;
};

// Frame options.frame of options.camera.
Result<ReferenceView> LoadReferenceView(const ReferenceOptions& options);

// Bakes what is not up to date.
Result<CommandResult> RunSceneReference(const ReferenceOptions& options,
                                        Progress& progress,
                                        Log& log);

}  // namespace lararium::app
