#pragma once

// The visitor's menu of a show: its items in the visitor's language, and its drawing.

#include <cstddef>
#include <vector>

#include "player/app/gaze_menu.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/text/menu.h"
#include "shared/show/show_content.h"

namespace lararium::player {

// The items that a show offers; empty if it has no caption font.
std::vector<MenuItem> ItemsOf(const show::ShowContent& content, const Choices& choices);

// The scale at which a menu with a number of items fits into a picture.
double ScaleFor(const geometry::CameraModel& picture, size_t items);

// Converts a menu for drawing. picture: pinhole camera of the target.
render::Menu PictureOf(const GazeMenu& menu,
                       const geometry::CameraModel& picture,
                       const Choices& choices);

}  // namespace lararium::player
