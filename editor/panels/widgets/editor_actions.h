#pragma once

// Requests of one part of the window to another. Panels append them; the window carries them out
// once in each frame, before it draws the panels.

#include <variant>
#include <vector>

#include "shared/drama/timeline_text.h"

namespace lararium::panels {

// The tabs below the views.
enum class BottomTab { kTimeline, kScript, kChecks, kMessages };

struct CloseWindow {};
struct CloseProject {};  // Shows the start page.
// Lets a requested end of the window or the project stop long work.
struct StopWorkAndLeave {};
struct StartTour {};
struct OpenTab {
  BottomTab tab = BottomTab::kTimeline;
};
// Opens the script and moves its cursor to a line.
struct GoToScriptLine {
  int line = 1;  // Counts from 1.
};
struct SelectTimelineItem {
  drama::TimelineItem item;
};
struct OpenOnionSettings {};  // Opens the settings of the onion skin.

using EditorAction = std::variant<CloseWindow,
                                  CloseProject,
                                  StopWorkAndLeave,
                                  StartTour,
                                  OpenTab,
                                  GoToScriptLine,
                                  SelectTimelineItem,
                                  OpenOnionSettings>;
using EditorActions = std::vector<EditorAction>;

}  // namespace lararium::panels
