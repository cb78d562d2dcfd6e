#pragma once

// The list of all keys, in a dialog.

#include <span>

#include "editor/panels/keys.h"

namespace lararium::panels {

// keys: since the last frame; the key that opened the list closes it too. False when it was
// closed.
bool ShowKeyList(std::span<const KeyPress> keys);

}  // namespace lararium::panels
