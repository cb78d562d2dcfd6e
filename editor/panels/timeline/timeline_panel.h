#pragma once

// The timeline of the drama: the lanes of track{...}, which can be edited, and the actions of the
// script.

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "editor/check/timeline_edits.h"
#include "editor/panels/timeline/timeline_maths.h"
#include "editor/panels/timeline/timeline_rows.h"
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
    return selection_.size() == 1 ? std::optional(selection_.front()) : std::nullopt;
  }
  // The selected task of the dry run, where no item is selected.
  std::optional<uint32_t> task() const { return selection_.empty() ? block_ : std::nullopt; }

 private:
  static constexpr float kRow = 24.0f;       // Logical pixels, like the following sizes.
  static constexpr float kLeastItem = 9.0f;  // The least width of an item.
  // The longest duration, in seconds, that an item without a length is drawn with.
  static constexpr double kLongNatural = 60.0;

  // The appearance of an item, computed when it is first visible.
  struct Face {
    std::string label;
    std::string line;      // The spoken line; empty: none.
    double natural = 0.0;  // Seconds that an item without a length lasts; 0: not known.
  };
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
  };

  void Refresh(const editor::Workspace& workspace);
  const Face& FaceOf(const editor::Workspace& workspace, const drama::TimelineItem& item);
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
  void DrawGutter(const TimelineRow& row, const ImVec2& at, float width) const;
  void DrawVoiceOf(const editor::Workspace& workspace,
                   const std::string& line,
                   double begin,
                   const ImVec2& from,
                   const ImVec2& to,
                   ImU32 colour,
                   ImDrawList& draw) const;
  // The index into shown_ of the row at a height, pixels from the top of the first row; -1: none.
  int RowAt(float y) const;
  void FillShown();
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
  void Delete(editor::Workspace& workspace);
  void Copy(const editor::Workspace& workspace);
  void Paste(editor::Workspace& workspace);
  void Duplicate(editor::Workspace& workspace);
  void Nudge(editor::Workspace& workspace, double seconds);
  void TrimToPlayhead(editor::Workspace& workspace, bool begins);
  void SelectAll(const editor::Workspace& workspace);
  // Selects a single item and makes it visible.
  void Choose(const drama::TimelineText& text, drama::TimelineItem item);
  // The start of a step by key: the item that was selected last, or the block.
  std::optional<TimelineStop> ChosenLast() const;
  static bool HasStop(const TimelineRow& row, const TimelineStop& stop);
  void ScrollToChosen();
  void StepSelection(const editor::Workspace& workspace, const TimelineStep& step);
  // Folds or unfolds the group of a row.
  void Fold(const TimelineRow& row);
  // Folds or unfolds the group of the last selection.
  void FoldChosen();
  // Folds all groups, or unfolds all where one is folded.
  void FoldAll();
  void JumpToEdge(editor::Workspace& workspace, int direction);
  void GoToScript(const editor::Workspace& workspace, EditorActions& actions);
  // Each returns true where the key belongs to it. shift: Shift is held.
  bool HandleTimeKey(editor::Workspace& workspace, KeyAction action, bool shift);
  bool HandleSelectionKey(editor::Workspace& workspace, KeyAction action, bool shift);
  bool HandleEditKey(editor::Workspace& workspace,
                     EditorActions& actions,
                     KeyAction action,
                     bool shift);
  std::vector<double> Naturals(const editor::Workspace& workspace);
  std::string NameOfSelection(const editor::Workspace& workspace);

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
  editor::ItemSet selection_;
  // The last item that keys selected; it may no longer exist.
  std::optional<drama::TimelineItem> last_;
  std::optional<uint32_t> block_;  // The selected task of the dry run.
  std::string block_group_;        // KeyOfGroup() of the row in which block_ is selected.
  Drag drag_;
  std::vector<TimelineRow> rows_;          // All rows.
  std::vector<const TimelineRow*> shown_;  // The rows outside folded groups.
  std::vector<float> tops_;  // The top of each row, and the bottom of the last one; pixels.
  std::set<std::string> folded_;
  bool objects_folded_at_first_ = false;
  int64_t script_ = -1;  // Revision of the script that rows_ show.
  int64_t run_ = -1;     // Number of the dry run that rows_ show.
  size_t cast_ = 0;      // The number of cast members.
  std::unordered_map<uint64_t, Face> faces_;
  std::vector<uint32_t> found_;  // Temporary.
  float rows_view_ = 0.0f;       // Visible height, pixels.
};

}  // namespace lararium::panels
