#pragma once

// What the chosen item of the timeline says.

#include <cstdint>
#include <optional>

#include "editor/app/timeline_edits.h"
#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

// block: a task of the dry run, where no item is chosen.
void ShowTimelineInspector(app::Workspace& workspace,
                           EditorState& state,
                           const app::ItemSet& selection,
                           std::optional<uint32_t> block);

}  // namespace lararium::panels
