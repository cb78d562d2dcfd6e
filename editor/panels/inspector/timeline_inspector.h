#pragma once

// The properties of the selected item of the timeline.

#include <cstdint>
#include <optional>

#include "editor/check/timeline_edits.h"
#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// block: a task of the dry run, where no item is selected.
void DrawTimelineInspector(editor::Workspace& workspace,
                           EditorState& state,
                           const editor::ItemSet& selection,
                           std::optional<uint32_t> block);

}  // namespace lararium::panels
