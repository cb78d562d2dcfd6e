#pragma once

// The keys of a frame, and which part of the window they belong to.

#include <vector>

#include "editor/panels/widgets/keyboard_focus.h"
#include "editor/panels/widgets/keys.h"

namespace lararium::panels {

// Which part receives keys that have another meaning in each part.
enum class Focus { kViews, kTimeline, kScript };

struct Input {
  std::vector<KeyPress> keys;  // The keys since the last frame.
  Focus focus = Focus::kViews;
  KeyboardFocus keyboard;
  bool dialog_open = false;  // A dialog is open; views and panels ignore keys.
};

}  // namespace lararium::panels
