#pragma once

// How people are to be drawn so that they look as if this camera had taken them.

#include "shared/geometry/camera_model.h"
#include "shared/light/camera_traits.h"
#include "shared/render/render_scene.h"
#include "shared/show/show.h"

namespace lararium::show {

// display: the pinhole of the picture, at its size. Where that shows the camera's pixels
// larger or smaller than they are, blur goes with them; noise does by itself.
render::CameraLook LookOf(const light::CameraTraits& traits,
                          const StagedFrame& staged,
                          const geometry::CameraModel& display);

}  // namespace lararium::show
