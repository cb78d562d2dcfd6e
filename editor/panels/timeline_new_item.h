#pragma once

// What a new item of the timeline says.

#include <string>

#include "editor/app/workspace.h"
#include "shared/core/json.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

// Its fields before it was edited. actor: whose lane it is on; at: seconds.
Json NewFields(const app::Workspace& workspace,
               drama::LaneKind kind,
               const std::string& actor,
               double at);

}  // namespace lararium::panels
