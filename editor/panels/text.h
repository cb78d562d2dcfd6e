#pragma once

#include "editor/app/text.h"

namespace lararium::panels {

using app::Label;
using app::Text;
using app::Tr;
using app::TrCount;
using app::TrIn;
using app::TrLater;

}  // namespace lararium::panels
