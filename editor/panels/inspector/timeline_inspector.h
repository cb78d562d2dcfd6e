#pragma once

// The properties of the selected item of the timeline.

#include <cstdint>
#include <optional>

#include "editor/check/timeline_edits.h"
#include "editor/panels/widgets/editor_actions.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// block: a task of the dry run, where no item is selected. new_language: the tag that is being
// typed for a new language of the lines.
void DrawTimelineInspector(editor::Workspace& workspace,
                           EditorActions& actions,
                           const editor::ItemSet& selection,
                           std::optional<uint32_t> block,
                           std::string& new_language);

}  // namespace lararium::panels
