#pragma once

#include "editor/text/text.h"

namespace lararium::panels {

using editor::Label;
using editor::Text;
using editor::Tr;
using editor::TrCount;
using editor::TrIn;
using editor::TrLater;

}  // namespace lararium::panels
