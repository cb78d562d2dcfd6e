#pragma once

#include <span>

#include "shared/core/embedded_text.h"

namespace lararium::drama {

// The files of lua/std, in the order in which they are loaded before every drama.
std::span<const EmbeddedText> StdScripts();

}  // namespace lararium::drama
