#pragma once

// The commands on the selected items of the timeline. Each is one edit of the script; without
// selected items they do nothing.

#include "editor/panels/timeline/timeline_items.h"
#include "editor/panels/timeline/timeline_selection.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// ripple: later items of the lanes move along.
void DeleteSelected(editor::Workspace& workspace,
                    TimelineSelection& selection,
                    TimelineItems& items,
                    bool ripple);
void CopySelected(const editor::Workspace& workspace, const TimelineSelection& selection);
// Adds the copied items at the playhead and selects them.
void PasteCopied(editor::Workspace& workspace, TimelineSelection& selection);
// Adds copies behind the selected items and selects the copies.
void DuplicateSelected(editor::Workspace& workspace,
                       TimelineSelection& selection,
                       TimelineItems& items);
void ShiftSelected(editor::Workspace& workspace,
                   const TimelineSelection& selection,
                   TimelineItems& items,
                   double seconds,
                   bool ripple);
// Moves the begin or the end of each selected item by a number of seconds.
void TrimSelected(editor::Workspace& workspace,
                  const TimelineSelection& selection,
                  TimelineItems& items,
                  bool begins,
                  double seconds,
                  bool ripple);
// Moves the begin or the end of the first selected item to the playhead, and those of the others by
// the same time.
void TrimToPlayhead(editor::Workspace& workspace,
                    const TimelineSelection& selection,
                    TimelineItems& items,
                    bool begins,
                    bool ripple);

}  // namespace lararium::panels
