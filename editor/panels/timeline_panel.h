#pragma once

// The drama along its time: what is written in track{...} as lanes that can be edited, and
// what the script does by itself.

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "editor/app/timeline_edits.h"
#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/timeline_maths.h"
#include "editor/panels/timeline_rows.h"
#include "editor/panels/timeline_steps.h"

namespace lararium::panels {

class TimelinePanel {
 public:
  // What belongs beside the tabs, then the rest of the panel.
  void ShowTools(app::Workspace& workspace, EditorState& state);
  void Show(app::Workspace& workspace, EditorState& state);

  // Takes the keys that mean something here out of the state.
  void HandleKeys(app::Workspace& workspace, EditorState& state);

 private:
  static constexpr float kRow = 24.0f;       // logical pixels, as are others
  static constexpr float kLeastItem = 9.0f;  // as wide as an item is at least
  // Items without a length last no longer than that, seconds.
  static constexpr double kLongNatural = 60.0;

  // What an item looks like, worked out when it is first seen.
  struct Face {
    std::string label;
    std::string line;      // that is spoken; empty: none
    double natural = 0.0;  // seconds that it lasts where no length is written; 0: not known
  };
  struct Drag {
    enum class Kind { kNone, kScrub, kMove, kTrimBegin, kTrimEnd, kBox, kPan };
    Kind kind = Kind::kNone;
    bool moved = false;           // further than a click
    drama::TimelineItem grabbed;  // the item under the mouse
    double from = 0.0;            // time where it began
    float from_y = 0.0f;          // of the rows, pixels
    double by = 0.0;              // seconds, as it is snapped
    double snapped_to = -1.0;     // a time that is drawn; below 0: none
    double pan_first = 0.0;       // of the scale when it began
    app::ItemSet before;          // what was selected
    std::vector<double> marks;    // what times snap to
  };
  // What is under the mouse.
  struct Hit {
    enum class Part { kNothing, kBody, kBegin, kEnd };
    Part part = Part::kNothing;
    std::optional<drama::TimelineItem> item;
    std::optional<uint32_t> block;
    int row = -1;
  };

  void Refresh(const app::Workspace& workspace);
  const Face& FaceOf(const app::Workspace& workspace, const drama::TimelineItem& item);
  app::TimeSpan Shown(const app::Workspace& workspace, const drama::TimelineItem& item);

  // Snap, ripple and fit: as buttons, or in a menu where those do not fit.
  void ShowSwitches(const app::Workspace& workspace);
  void ShowSwitchMenu(const app::Workspace& workspace);
  void ShowRuler(app::Workspace& workspace, float height);
  void ShowRows(app::Workspace& workspace, EditorState& state);
  void DrawRow(const app::Workspace& workspace,
               const TimelineRow& row,
               float top,
               float height,
               const Hit& hit,
               ImDrawList& draw);
  void DrawItems(const app::Workspace& workspace,
                 const TimelineRow& row,
                 float top,
                 float height,
                 const Hit& hit,
                 ImDrawList& draw);
  void DrawBlocks(const app::Workspace& workspace,
                  const TimelineRow& row,
                  float top,
                  float height,
                  const Hit& hit,
                  ImDrawList& draw);
  void DrawGutter(const TimelineRow& row, const ImVec2& at, float width) const;
  void DrawVoiceOf(const app::Workspace& workspace,
                   const std::string& line,
                   double begin,
                   const ImVec2& from,
                   const ImVec2& to,
                   ImU32 colour,
                   ImDrawList& draw) const;
  // Which of shown_ lies at a height, pixels from the top of the first; -1: none.
  int RowAt(float y) const;
  void FillShown();
  // x0 and x1 of what takes a time on the screen; at least wide enough to be hit.
  std::pair<float, float> Extent(const app::TimeSpan& span) const;

  Hit HitAt(const app::Workspace& workspace, const ImVec2& mouse, float rows_top);
  void HandleMouse(app::Workspace& workspace, EditorState& state, float rows_top, bool hovered);
  void BeginDrag(app::Workspace& workspace, EditorState& state, const Hit& hit, float rows_top);
  void UpdateDrag(app::Workspace& workspace, float rows_top);
  void EndDrag(app::Workspace& workspace);
  void SnapDrag(const app::Workspace& workspace, double by);
  void SelectBox(const app::Workspace& workspace, double to, float y);
  void HandleWheel();
  void ShowTooltip(app::Workspace& workspace, const Hit& hit);
  void ShowContextMenu(app::Workspace& workspace, EditorState& state);
  void ShowAddMenu(app::Workspace& workspace);
  void ShowKindMenu(app::Workspace& workspace, const std::string& actor);

  // Commands.
  void Add(app::Workspace& workspace, drama::LaneKind kind, const std::string& actor);
  void Delete(app::Workspace& workspace);
  void Copy(const app::Workspace& workspace);
  void Paste(app::Workspace& workspace);
  void Duplicate(app::Workspace& workspace);
  void Nudge(app::Workspace& workspace, double seconds);
  void TrimToPlayhead(app::Workspace& workspace, bool begins);
  void SelectAll(const app::Workspace& workspace);
  // One alone, and brings it into view.
  void Choose(const drama::TimelineText& text, drama::TimelineItem item);
  // What a step of the keys begins at: the item that was chosen last, or the block.
  std::optional<TimelineStop> ChosenLast() const;
  static bool HasStop(const TimelineRow& row, const TimelineStop& stop);
  void ScrollToChosen();
  void StepSelection(const app::Workspace& workspace, const TimelineStep& step);
  // The group of a row, or unfolds it.
  void Fold(const TimelineRow& row);
  // That of what was chosen last.
  void FoldChosen();
  // All of them; unfolds them where any is folded.
  void FoldAll();
  void JumpToEdge(app::Workspace& workspace, int direction);
  void GoToScript(const app::Workspace& workspace, EditorState& state);
  // Each true where the key was one of its kind. shift: it is held.
  bool HandleTimeKey(app::Workspace& workspace, KeyAction action, bool shift);
  bool HandleSelectionKey(app::Workspace& workspace, KeyAction action, bool shift);
  bool HandleEditKey(app::Workspace& workspace, EditorState& state, KeyAction action, bool shift);
  std::vector<double> Naturals(const app::Workspace& workspace);
  std::string NameOfSelection(const app::Workspace& workspace);

  TimeScale scale_;
  bool fitted_ = false;
  bool snap_ = true;
  bool ripple_ = false;
  bool open_add_ = false;
  bool open_context_ = false;
  bool scroll_to_chosen_ = false;  // in the rows that are shown next
  Hit context_;
  app::ItemSet selection_;
  std::optional<drama::TimelineItem> last_;  // that keys chose; may be gone
  std::optional<uint32_t> block_;            // a task that is selected,
  std::string block_group_;                  // in the row of this KeyOfGroup()
  Drag drag_;
  std::vector<TimelineRow> rows_;          // all
  std::vector<const TimelineRow*> shown_;  // without those of folded groups
  std::vector<float> tops_;                // of each, and of what would follow; pixels
  std::set<std::string> folded_;
  bool objects_folded_at_first_ = false;
  int64_t script_ = -1;  // revision that rows_ are of
  int64_t run_ = -1;     // likewise
  size_t cast_ = 0;      // how many there are
  std::unordered_map<uint64_t, Face> faces_;
  std::vector<uint32_t> found_;  // scratch
  float rows_view_ = 0.0f;       // height that is seen, pixels
};

}  // namespace lararium::panels
