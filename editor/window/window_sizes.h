#pragma once

// Sizes of the window and its panels, kept for the next start.

#include <array>
#include <filesystem>

#include "shared/core/status.h"

namespace lararium::editor {

// Logical pixels, as dragged. Panels that do not fit are displayed smaller.
struct PanelSizes {
  double outliner = 224.0;  // Width.
  double inspector = 336.0;
  std::array<double, 4> bottom = {336.0, 400.0, 240.0, 136.0};  // Height of each tab.

  friend bool operator==(const PanelSizes&, const PanelSizes&) = default;
};

struct WindowSizes {
  int width = 1440;  // Screen coordinates; size when not maximised.
  int height = 900;
  bool maximized = false;
  PanelSizes panels;

  friend bool operator==(const WindowSizes&, const WindowSizes&) = default;
};

// Without a file: the defaults above. An unreadable file is moved aside by SetAside().
Result<WindowSizes> LoadWindowSizes(const std::filesystem::path& file);
// Creates the folder if necessary.
Status SaveWindowSizes(const std::filesystem::path& file, const WindowSizes& sizes);

}  // namespace lararium::editor
