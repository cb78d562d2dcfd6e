#pragma once

// The fields of a new item of the timeline.

#include <string>

#include "editor/session/workspace.h"
#include "shared/core/json.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

// The initial fields. actor: the owner of the lane. at: seconds.
Json NewFields(const editor::Workspace& workspace,
               drama::LaneKind kind,
               const std::string& actor,
               double at);

}  // namespace lararium::panels
