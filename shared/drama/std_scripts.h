#pragma once

#include <span>

#include "shared/core/embedded_text.h"

namespace lararium::drama {

// lua/std, in the order in which its files are loaded before every drama.
std::span<const EmbeddedText> StdScripts();

}  // namespace lararium::drama
