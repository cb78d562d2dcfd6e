#pragma once

// The look that makes people appear as if this camera had recorded them.

#include "shared/geometry/camera_model.h"
#include "shared/light/camera_traits.h"
#include "shared/render/render_scene.h"
#include "shared/show/show.h"

namespace lararium::show {

// display: the picture's pinhole, at its size. If it scales the camera's pixels, blur scales with
// them; the renderer scales noise itself.
render::CameraLook LookOf(const light::CameraTraits& traits,
                          const StagedFrame& staged,
                          const geometry::CameraModel& display);

// How people move while the rows of the camera's image are read. nullopt: not visibly, or the
// motion is not known.
std::optional<render::SceneShutter> ShutterOf(const StagedFrame& staged);

}  // namespace lararium::show
