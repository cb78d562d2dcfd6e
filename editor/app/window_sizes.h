#pragma once

// How large the window and its panels were, for the next start.

#include <array>
#include <filesystem>

#include "shared/core/status.h"

namespace lararium::app {

// Logical pixels, as dragged; what a window has no room for is shown smaller.
struct PanelSizes {
  double outliner = 224.0;  // width
  double inspector = 336.0;
  std::array<double, 4> bottom = {336.0, 400.0, 240.0, 136.0};  // height of each tab

  friend bool operator==(const PanelSizes&, const PanelSizes&) = default;
};

struct WindowSizes {
  int width = 1440;  // screen coordinates, of the window when it is not maximized
  int height = 900;
  bool maximized = false;
  PanelSizes panels;

  friend bool operator==(const WindowSizes&, const WindowSizes&) = default;
};

// Without a file: as above. One that cannot be read is moved aside, as SetAside() does.
Result<WindowSizes> LoadWindowSizes(const std::filesystem::path& file);
// Makes the folder too.
Status SaveWindowSizes(const std::filesystem::path& file, const WindowSizes& sizes);

}  // namespace lararium::app
