#pragma once

// The timeline of the drama: the lanes of track{...}, which can be edited, and the actions of the
// script.

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "editor/check/timeline_edits.h"
#include "editor/panels/timeline/timeline_items.h"
#include "editor/panels/timeline/timeline_layout.h"
#include "editor/panels/timeline/timeline_maths.h"
#include "editor/panels/timeline/timeline_rows.h"
#include "editor/panels/timeline/timeline_selection.h"
#include "editor/panels/timeline/timeline_steps.h"
#include "editor/panels/widgets/editor_actions.h"
#include "editor/panels/widgets/input.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

class TimelinePanel {
 public:
  // The buttons beside the tabs, and the panel itself.
  void DrawTools(editor::Workspace& workspace, Input& input);
  void Show(editor::Workspace& workspace, Input& input, EditorActions& actions);

  // Handles the keys of the timeline and removes them from input.keys.
  void HandleKeys(editor::Workspace& workspace, Input& input, EditorActions& actions);

  // Selects an item when the panel is shown next.
  void Select(const drama::TimelineItem& item) { asked_ = item; }
  // The selection if it is a single item; otherwise nullopt.
  std::optional<drama::TimelineItem> single_item() const {
    const editor::ItemSet& items = selection_.items();
    return items.size() == 1 ? std::optional(items.front()) : std::nullopt;
  }
  // The selected task of the dry run, where no item is selected.
  std::optional<uint32_t> task() const {
    return selection_.HasItems() ? std::nullopt : selection_.block();
  }

 private:
  static constexpr float kLeastItem = 9.0f;  // The least width of an item, logical pixels.

  struct Drag {
    enum class Kind { kNone, kScrub, kMove, kTrimBegin, kTrimEnd, kBox, kPan };
    Kind kind = Kind::kNone;
    bool moved = false;           // Moved farther than a click allows.
    drama::TimelineItem grabbed;  // The item under the pointer.
    double from = 0.0;            // The time where the drag began.
    float from_y = 0.0f;          // Position within the rows, pixels.
    double by = 0.0;              // The move in seconds, after snapping.
    double snapped_to = -1.0;     // A time that is marked; below 0: none.
    double pan_first = 0.0;       // TimeScale::first at the beginning of the drag.
    editor::ItemSet before;       // The selection before the drag.
    std::vector<double> marks;    // Times to which the drag snaps.
  };
  // What is under the pointer.
  struct Hit {
    enum class Part { kNothing, kBody, kBegin, kEnd };
    Part part = Part::kNothing;
    std::optional<drama::TimelineItem> item;
    std::optional<uint32_t> block;
    int row = -1;
    std::string group = {};  // KeyOfGroup() of the row, for a block.
  };

  void Refresh(const editor::Workspace& workspace);
  // The time span that an item is drawn with while it is dragged.
  editor::TimeSpan Shown(const editor::Workspace& workspace, const drama::TimelineItem& item);

  // Snap, ripple and fit, as buttons or as a menu where they do not fit.
  void DrawSwitches(const editor::Workspace& workspace);
  void DrawSwitchMenu(const editor::Workspace& workspace);
  void DrawRuler(editor::Workspace& workspace, float height);
  void DrawRows(editor::Workspace& workspace, Input& input, EditorActions& actions);
  void DrawRow(const editor::Workspace& workspace,
               const TimelineRow& row,
               float top,
               float height,
               const Hit& hit,
               ImDrawList& draw);
  void DrawItems(const editor::Workspace& workspace,
                 const TimelineRow& row,
                 float top,
                 float height,
                 const Hit& hit,
                 ImDrawList& draw);
  void DrawBlocks(const editor::Workspace& workspace,
                  const TimelineRow& row,
                  float top,
                  float height,
                  const Hit& hit,
                  ImDrawList& draw);
  void DrawGutter(const editor::Workspace& workspace,
                  const TimelineRow& row,
                  const ImVec2& at,
                  float width) const;
  void DrawVoiceOf(const editor::Workspace& workspace,
                   const std::string& line,
                   double begin,
                   const ImVec2& from,
                   const ImVec2& to,
                   ImU32 colour,
                   ImDrawList& draw) const;
  // The left and right end of a time span on the screen, at least wide enough for the pointer.
  std::pair<float, float> Extent(const editor::TimeSpan& span) const;

  Hit HitAt(const editor::Workspace& workspace, const ImVec2& mouse, float rows_top);
  void HandleMouse(editor::Workspace& workspace,
                   Input& input,
                   EditorActions& actions,
                   float rows_top,
                   bool hovered);
  void BeginDrag(editor::Workspace& workspace,
                 Input& input,
                 EditorActions& actions,
                 const Hit& hit,
                 float rows_top);
  void UpdateDrag(editor::Workspace& workspace, float rows_top);
  void EndDrag(editor::Workspace& workspace);
  void SnapDrag(const editor::Workspace& workspace, double by);
  void SelectBox(const editor::Workspace& workspace, double to, float y);
  void HandleWheel();
  void DrawTooltip(editor::Workspace& workspace, const Hit& hit);
  void DrawContextMenu(editor::Workspace& workspace, EditorActions& actions);
  void DrawAddMenu(editor::Workspace& workspace);
  void DrawKindMenu(editor::Workspace& workspace, const std::string& actor);

  // The commands of the panel.
  void Add(editor::Workspace& workspace, drama::LaneKind kind, const std::string& actor);
  // Selects a single item and makes it visible.
  void Choose(const drama::TimelineText& text, drama::TimelineItem item);
  void ScrollToChosen();
  void StepSelection(const editor::Workspace& workspace, const TimelineStep& step);
  // Folds or unfolds the group of the last selection.
  void FoldChosen();
  void JumpToEdge(editor::Workspace& workspace, int direction);
  void GoToScript(const editor::Workspace& workspace, EditorActions& actions);
  // Each returns true where the key belongs to it. shift: Shift is held.
  bool HandleTimeKey(editor::Workspace& workspace, KeyAction action, bool shift);
  bool HandleSelectionKey(editor::Workspace& workspace, KeyAction action, bool shift);
  bool HandleEditKey(editor::Workspace& workspace,
                     EditorActions& actions,
                     KeyAction action,
                     bool shift);

  TimeScale scale_;
  std::optional<drama::TimelineItem> asked_;  // See Select().
  std::string new_language_;                  // See DrawTimelineInspector().
  bool fitted_ = false;
  bool snap_ = true;
  bool ripple_ = false;
  bool open_add_ = false;
  bool open_context_ = false;
  bool scroll_to_chosen_ = false;  // When the rows are shown next.
  Hit context_;
  TimelineSelection selection_;
  Drag drag_;
  TimelineLayout layout_;
  TimelineItems items_;
  std::vector<uint32_t> found_;  // Temporary.
};

}  // namespace lararium::panels
