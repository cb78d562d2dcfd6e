#pragma once

// The visitor's menu of a show: its items in the visitor's language, and how it is drawn.

#include <cstddef>
#include <vector>

#include "player/gaze_menu.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/menu.h"
#include "shared/show/show_content.h"

namespace lararium::player {

// What can be chosen of a show; nothing where it has no letters.
std::vector<MenuItem> ItemsOf(const show::ShowContent& content, const Choices& choices);

// How large a menu of so many items fits into what a picture shows of the view.
double ScaleFor(const geometry::CameraModel& picture, size_t items);

// picture: the pinhole of the target.
render::Menu PictureOf(const GazeMenu& menu,
                       const geometry::CameraModel& picture,
                       const Choices& choices);

}  // namespace lararium::player
