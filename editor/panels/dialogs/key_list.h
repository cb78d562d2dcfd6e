#pragma once

// The list of all keys as a dialog.

#include <span>

#include "editor/panels/widgets/keys.h"

namespace lararium::panels {

// keys: those since the last frame; the key that opens the list also closes it. Returns false when
// it was closed.
bool DrawKeyList(std::span<const KeyPress> keys);

}  // namespace lararium::panels
