// Input of the timeline: hit testing, drags and keys.

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/panels/timeline/timeline_commands.h"
#include "editor/panels/timeline/timeline_draw.h"
#include "editor/panels/timeline/timeline_labels.h"
#include "editor/panels/timeline/timeline_new_item.h"
#include "editor/panels/timeline/timeline_panel.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

using drama::LaneKind;
using drama::TaskRecord;
using drama::TimelineItem;
using drama::TimelineLane;
using drama::TimelineText;

namespace {

// Logical pixels.
constexpr float kEdge = 6.0f;   // The edge of an item that trims it.
constexpr float kClick = 4.0f;  // A longer move is a drag.
constexpr float kSnapReach = 8.0f;

constexpr double kFrame = 1.0 / 30.0;  // Seconds; the step of the keys.
constexpr double kNudge = 0.1;

}  // namespace

TimelinePanel::Hit TimelinePanel::HitAt(const editor::Workspace& workspace,
                                        const ImVec2& mouse,
                                        float rows_top) {
  Hit hit;
  hit.row = layout_.RowAt(mouse.y - rows_top);
  if (hit.row < 0 || mouse.x < scale_.left) {
    return hit;
  }
  const TimelineRow& row = layout_.Shown(hit.row);
  const double before = scale_.TimeAt(mouse.x - Px(kLeastItem));
  const double after = scale_.TimeAt(mouse.x + Px(1));
  const auto covers = [&](const editor::TimeSpan& span) {
    const auto [x0, x1] = Extent(span);
    if (mouse.x < x0 || mouse.x > x1) {
      return false;
    }
    const float edge = std::min(Px(kEdge), 0.3f * (x1 - x0));
    hit.part = mouse.x < x0 + edge   ? Hit::Part::kBegin
               : mouse.x > x1 - edge ? Hit::Part::kEnd
                                     : Hit::Part::kBody;
    return true;
  };
  // Of several items, the one that is drawn last.
  if (row.kind == TimelineRow::Kind::kItems) {
    for (const size_t lane : row.lanes) {
      found_.clear();
      workspace.project().script().timeline()->Query(lane, before - TimelineItems::kLongNatural,
                                                     after, found_);
      for (auto item = found_.rbegin(); item != found_.rend() && !hit.item; ++item) {
        if (covers(Shown(workspace, {lane, *item}))) {
          hit.item = {lane, *item};
        }
      }
    }
    if (hit.item && row.lane == LaneKind::kMarkers) {
      hit.part = Hit::Part::kBody;
    }
  } else if (row.kind == TimelineRow::Kind::kBlocks && workspace.dry_run().newest() != nullptr) {
    found_.clear();
    row.index.Query(before, after, found_);
    for (auto block = found_.rbegin(); block != found_.rend() && !hit.block; ++block) {
      const TaskRecord& task = workspace.dry_run().newest()->tasks[row.blocks[*block]];
      if (covers({task.began, task.ended})) {
        hit.block = row.blocks[*block];
        hit.group = KeyOfGroup(row);
        hit.part = Hit::Part::kBody;
      }
    }
  }
  return hit;
}

void TimelinePanel::BeginDrag(editor::Workspace& workspace,
                              Input& input,
                              EditorActions& actions,
                              const Hit& hit,
                              float rows_top) {
  const ImGuiIO& io = ImGui::GetIO();
  input.focus = Focus::kTimeline;
  drag_ = {};
  drag_.from = scale_.TimeAt(io.MousePos.x);
  drag_.from_y = io.MousePos.y - rows_top;
  drag_.before = selection_.items();
  const bool adds = io.KeyCtrl || io.KeyShift;
  if (hit.block) {
    selection_.SelectBlock(*hit.block, hit.group);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      GoToScript(workspace, actions);
    }
    return;
  }
  selection_.ClearBlock();
  if (!hit.item) {
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && hit.row >= 0 &&
        layout_.Shown(hit.row).kind == TimelineRow::Kind::kItems) {
      const TimelineRow& row = layout_.Shown(hit.row);
      workspace.playback().SetTime(std::max(drag_.from, 0.0));
      Add(workspace, row.lane, row.group);
      return;
    }
    drag_.kind = Drag::Kind::kBox;
    if (!adds) {
      selection_.ClearItems();
    }
    return;
  }
  if (adds) {
    selection_.Toggle(*hit.item);
    return;
  }
  if (!editor::Contains(selection_.items(), *hit.item)) {
    selection_.SetItems({*hit.item});
  }
  drag_.grabbed = *hit.item;
  drag_.kind = hit.part == Hit::Part::kBegin ? Drag::Kind::kTrimBegin
               : hit.part == Hit::Part::kEnd ? Drag::Kind::kTrimEnd
                                             : Drag::Kind::kMove;
  // The drag snaps to the playhead and to the ends of all other items.
  drag_.marks = {0.0, workspace.playback().time()};
  const TimelineText& text = *workspace.project().script().timeline();
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    const TimelineLane& in = text.lanes()[lane];
    for (size_t i = 0; i < in.size(); ++i) {
      if (!editor::Contains(selection_.items(), {lane, i})) {
        drag_.marks.push_back(in.at[i]);
        drag_.marks.push_back(in.at[i] + in.length[i]);
      }
    }
  }
  if (const editor::DramaRun* run = workspace.dry_run().newest()) {
    for (const TaskRecord& task : run->tasks) {
      if (!task.from_timeline) {
        drag_.marks.push_back(task.began);
        drag_.marks.push_back(task.ended);
      }
    }
  }
}

// Snaps a drag. by: the move of the mouse, seconds.
void TimelinePanel::SnapDrag(const editor::Workspace& workspace, double by) {
  const TimelineText& text = *workspace.project().script().timeline();
  const double by_before = std::exchange(drag_.by, 0.0);
  const editor::TimeSpan grabbed = Shown(workspace, drag_.grabbed);
  drag_.by = by_before;
  drag_.snapped_to = -1.0;
  if (snap_ && !ImGui::GetIO().KeyAlt) {
    const RulerStep step = ChooseStep(scale_.seconds_per_px, Px(76));
    const double grid = step.seconds / step.parts;
    const double reach = Px(kSnapReach) * scale_.seconds_per_px;
    double best = reach;
    const auto draw_to = [&](double time) {
      const double to = Snap(time + by, drag_.marks, grid, reach);
      if (to != time + by && std::abs(to - time - by) < best) {
        best = std::abs(to - time - by);
        drag_.snapped_to = to;
      }
      return to - time - by;
    };
    const bool begins = drag_.kind != Drag::Kind::kTrimEnd;
    const bool ends = drag_.kind != Drag::Kind::kTrimBegin && grabbed.end > grabbed.begin;
    const double of_begin = begins ? draw_to(grabbed.begin) : 0.0;
    const double of_end = ends ? draw_to(grabbed.end) : 0.0;
    const bool end_nearer =
        of_end != 0.0 && (of_begin == 0.0 || std::abs(of_end) < std::abs(of_begin));
    by += end_nearer ? of_end : of_begin;
  }
  if (drag_.kind == Drag::Kind::kMove) {
    const double allowed = editor::ClampMove(text, selection_.items(), by, ripple_);
    drag_.snapped_to = allowed == by ? drag_.snapped_to : -1.0;
    by = allowed;
  }
  drag_.by = by;
}

void TimelinePanel::SelectBox(const editor::Workspace& workspace, double to, float y) {
  const bool adds = ImGui::GetIO().KeyCtrl || ImGui::GetIO().KeyShift;
  editor::ItemSet chosen = adds ? drag_.before : editor::ItemSet();
  const double begin = std::min(drag_.from, to);
  const double end = std::max(drag_.from, to);
  const float low = std::min(drag_.from_y, y);
  const float high = std::max(drag_.from_y, y);
  for (size_t r = 0; r < layout_.shown().size(); ++r) {
    const TimelineRow& row = *layout_.shown()[r];
    if (layout_.Top(r) > high || layout_.Top(r + 1) < low) {
      continue;
    }
    for (const size_t lane : row.lanes) {
      found_.clear();
      workspace.project().script().timeline()->Query(lane, begin - TimelineItems::kLongNatural, end,
                                                     found_);
      for (const uint32_t item : found_) {
        if (Shown(workspace, {lane, item}).end >= begin) {
          chosen.push_back({lane, item});
        }
      }
    }
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  selection_.SetItems(std::move(chosen));
}

void TimelinePanel::UpdateDrag(editor::Workspace& workspace, float rows_top) {
  const ImGuiIO& io = ImGui::GetIO();
  const double now = scale_.TimeAt(io.MousePos.x);
  const float y = io.MousePos.y - rows_top;
  drag_.moved |= ImGui::IsMouseDragging(ImGuiMouseButton_Left, Px(kClick));
  if (!drag_.moved || workspace.project().script().timeline() == nullptr) {
    return;
  }
  switch (drag_.kind) {
    case Drag::Kind::kMove:
    case Drag::Kind::kTrimBegin:
    case Drag::Kind::kTrimEnd:
      SnapDrag(workspace, now - drag_.from);
      break;
    case Drag::Kind::kBox:
      SelectBox(workspace, now, y);
      break;
    default:
      break;
  }
}

void TimelinePanel::EndDrag(editor::Workspace& workspace) {
  const Drag drag = std::exchange(drag_, Drag());
  if (!drag.moved || drag.by == 0.0 || workspace.project().script().timeline() == nullptr) {
    if (!drag.moved && drag.kind == Drag::Kind::kMove) {
      selection_.SetItems({drag.grabbed});  // A click on one of several selected items.
    }
    return;
  }
  if (drag.kind == Drag::Kind::kMove) {
    ShiftSelected(workspace, selection_, items_, drag.by, ripple_);
  } else if (drag.kind == Drag::Kind::kTrimBegin || drag.kind == Drag::Kind::kTrimEnd) {
    TrimSelected(workspace, selection_, items_, drag.kind == Drag::Kind::kTrimBegin, drag.by,
                 ripple_);
  }
}

void TimelinePanel::HandleWheel() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl && io.MouseWheel != 0.0f) {
    Zoom(scale_, std::pow(0.8, io.MouseWheel), std::max(io.MousePos.x, scale_.left));
    return;
  }
  const float sideways = io.KeyShift ? io.MouseWheel + io.MouseWheelH : io.MouseWheelH;
  if (sideways != 0.0f) {
    scale_.first = std::max(scale_.first - sideways * Px(60) * scale_.seconds_per_px, 0.0);
  } else if (io.MouseWheel != 0.0f) {
    ImGui::SetScrollY(ImGui::GetScrollY() - io.MouseWheel * Px(2 * TimelineLayout::kRow));
  }
}

void TimelinePanel::HandleMouse(editor::Workspace& workspace,
                                Input& input,
                                EditorActions& actions,
                                float rows_top,
                                bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool active = ImGui::IsItemActive();
  const bool in_gutter = io.MousePos.x < scale_.left;
  if (hovered) {
    HandleWheel();
  }
  const Hit hit = hovered ? HitAt(workspace, io.MousePos, rows_top) : Hit();
  if (ImGui::IsItemActivated()) {
    if (io.MouseClicked[ImGuiMouseButton_Middle]) {
      drag_ = {};
      drag_.kind = Drag::Kind::kPan;
      drag_.pan_first = scale_.first;
      drag_.from_y = io.MousePos.x;
    } else if (io.MouseClicked[ImGuiMouseButton_Right] && !in_gutter) {
      input.focus = Focus::kTimeline;
      if (hit.item && !editor::Contains(selection_.items(), *hit.item)) {
        selection_.SetItems({*hit.item});
        selection_.ClearBlock();
      }
      if (hit.block) {
        selection_.SelectBlock(*hit.block, hit.group);
      }
      context_ = hit;
      open_context_ = true;
      drag_ = {};
    } else if (in_gutter) {
      input.focus = Focus::kTimeline;
      if (hit.row >= 0 && layout_.Shown(hit.row).kind == TimelineRow::Kind::kHeading) {
        layout_.Fold(layout_.Shown(hit.row));
      }
      drag_ = {};
    } else {
      BeginDrag(workspace, input, actions, hit, rows_top);
    }
  } else if (active && drag_.kind == Drag::Kind::kPan) {
    scale_.first =
        std::max(drag_.pan_first - (io.MousePos.x - drag_.from_y) * scale_.seconds_per_px, 0.0);
  } else if (active) {
    UpdateDrag(workspace, rows_top);
  }
  if (ImGui::IsItemDeactivated() && drag_.kind != Drag::Kind::kScrub) {
    EndDrag(workspace);
  }
  if (hovered && in_gutter && !active && hit.row >= 0 &&
      layout_.Shown(hit.row).kind == TimelineRow::Kind::kHeading) {
    ImGui::SetTooltip("%s", WithKey(Tr("A click folds its lanes away, and unfolds them; by keys, "
                                       "those of what is chosen"),
                                    KeyAction::kFold)
                                .c_str());
  }
  if (hovered && (hit.item || hit.block) && !active) {
    const bool edge = hit.part == Hit::Part::kBegin || hit.part == Hit::Part::kEnd;
    ImGui::SetMouseCursor(edge ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_Arrow);
    DrawTooltip(workspace, hit);
  }
}

void TimelinePanel::DrawTooltip(editor::Workspace& workspace, const Hit& hit) {
  std::string title;
  std::string times;
  std::string hint;
  if (hit.item) {
    const editor::TimeSpan span = Shown(workspace, *hit.item);
    const TimelineLane& lane = workspace.project().script().timeline()->lanes()[hit.item->lane];
    title = std::string(ItemTitle(lane.kind)) + ": " + items_.FaceOf(workspace, *hit.item).label;
    times = FormatTime(span.begin, 0.01) + " \xe2\x80\x93 " + FormatTime(span.end, 0.01);
    hint = Text(Tr("line %zu of the script"),
                workspace.project().script().timeline()->LineOf(*hit.item));
  } else {
    const TaskRecord& task = workspace.dry_run().newest()->tasks[*hit.block];
    title = task.actor + ": " + BlockLabel(task, false);
    times = FormatTime(task.began, 0.01) + " \xe2\x80\x93 " + FormatTime(task.ended, 0.01);
    hint = task.failed
               ? task.message
               : Text(Tr("by the script, %s; double-click to go there"), task.where.c_str());
  }
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(title.c_str());
  DimText(times);
  DimText(hint);
  ImGui::EndTooltip();
}

// ---- Keys ----

void TimelinePanel::Add(editor::Workspace& workspace, LaneKind kind, const std::string& actor) {
  editor::ItemSet added;
  const double at = std::round(workspace.playback().time() * 100.0) / 100.0;
  const bool done = workspace.project().EditTimeline(
      Sentence("add %s", {std::string(ItemTitle(kind))}), [&](TimelineText& text) {
        return editor::AddItem(text, kind, actor, NewFields(workspace, kind, actor, at), added);
      });
  if (done) {
    selection_.SetItems(added);
    selection_.ClearBlock();
    layout_.UnfoldPerson(actor);
  }
}

void TimelinePanel::Choose(const TimelineText& text, TimelineItem item) {
  const TimelineLane& lane = text.lanes()[item.lane];
  selection_.SelectItem(item);
  layout_.UnfoldPerson(lane.actor);
  ScrollTo(scale_, lane.at[item.item]);
  scroll_to_chosen_ = true;
}

void TimelinePanel::StepSelection(const editor::Workspace& workspace, const TimelineStep& step) {
  const TimelineText& text = *workspace.project().script().timeline();
  const editor::DramaRun* run = workspace.dry_run().newest();
  const std::vector<TimelineLine> lines = LinesOf(
      layout_.rows(), text, run != nullptr ? std::span(run->tasks) : std::span<const TaskRecord>(),
      layout_.folded());
  const std::optional<TimelineStop> from = selection_.Last();
  const std::optional<TimelineStop> to = StepFrom(lines, from, workspace.playback().time(), step);
  if (!to || (step.items && !to->item)) {
    return;
  }
  if (!to->item) {
    selection_.SelectBlock(to->block, to->group);
    ScrollTo(scale_, to->at);
    scroll_to_chosen_ = true;
    return;
  }
  editor::ItemSet chosen = selection_.items();
  Choose(text, *to->item);
  if (step.items) {
    Extend(chosen, from ? from->item : std::nullopt, *to->item);
    selection_.SetItems(std::move(chosen));
  }
}

void TimelinePanel::FoldChosen() {
  const std::optional<TimelineStop> chosen = selection_.Last();
  const auto row =
      std::find_if(layout_.rows().begin(), layout_.rows().end(),
                   [&](const TimelineRow& of) { return chosen && HasStop(of, *chosen); });
  if (row != layout_.rows().end()) {
    layout_.Fold(*row);
    scroll_to_chosen_ = true;
  }
}

// Moves the playhead to the next begin or end of an item.
void TimelinePanel::JumpToEdge(editor::Workspace& workspace, int direction) {
  constexpr double kSame = 1e-3;
  const double now = workspace.playback().time();
  double best = direction > 0 ? workspace.playback().duration() : 0.0;
  const auto offer = [&](double time) {
    if (direction > 0 ? time > now + kSame && time < best : time < now - kSame && time > best) {
      best = time;
    }
  };
  if (const TimelineText* text = workspace.project().script().timeline()) {
    for (const TimelineLane& lane : text->lanes()) {
      for (size_t i = 0; i < lane.size(); ++i) {
        offer(lane.at[i]);
        offer(lane.at[i] + lane.length[i]);
      }
    }
  }
  if (const editor::DramaRun* run = workspace.dry_run().newest()) {
    for (const TaskRecord& task : run->tasks) {
      offer(task.began);
      offer(task.ended);
    }
  }
  workspace.playback().SetPlaying(false);
  workspace.playback().SetTime(best);
  ScrollTo(scale_, best);
}

void TimelinePanel::GoToScript(const editor::Workspace& workspace, EditorActions& actions) {
  int line = 0;
  if (selection_.HasItems() && workspace.project().script().timeline() != nullptr) {
    line = static_cast<int>(
        workspace.project().script().timeline()->LineOf(selection_.items().front()));
  } else if (selection_.block() && workspace.dry_run().newest() != nullptr) {
    line = LineOfPlace(workspace.dry_run().newest()->tasks[*selection_.block()].where,
                       workspace.project().paths().Drama().filename().string());
  }
  if (line > 0) {
    actions.push_back(GoToScriptLine{line});
  }
}

bool TimelinePanel::HandleSelectionKey(editor::Workspace& workspace, KeyAction action, bool shift) {
  switch (action) {
    case KeyAction::kSelectAll:
      selection_.SelectAll(*workspace.project().script().timeline());
      return true;
    case KeyAction::kSelectNone:
      drag_ = {};
      selection_.ClearItems();
      selection_.ClearBlock();
      return true;
    case KeyAction::kSelectBefore:
      StepSelection(workspace, {-1, 0, shift});
      return true;
    case KeyAction::kSelectAfter:
      StepSelection(workspace, {1, 0, shift});
      return true;
    case KeyAction::kSelectAbove:
      StepSelection(workspace, {0, -1, shift});
      return true;
    case KeyAction::kSelectBelow:
      StepSelection(workspace, {0, 1, shift});
      return true;
    case KeyAction::kFold:
      shift ? layout_.FoldAll() : FoldChosen();
      return true;
    default:
      return false;
  }
}

bool TimelinePanel::HandleTimeKey(editor::Workspace& workspace, KeyAction action, bool shift) {
  const auto go = [&](double time) {
    workspace.playback().SetPlaying(false);
    workspace.playback().SetTime(std::clamp(
        time, 0.0, std::max(workspace.playback().duration(), workspace.playback().time())));
    ScrollTo(scale_, workspace.playback().time());
  };
  switch (action) {
    case KeyAction::kBack:
      go(workspace.playback().time() - (shift ? 1.0 : kFrame));
      return true;
    case KeyAction::kOn:
      go(workspace.playback().time() + (shift ? 1.0 : kFrame));
      return true;
    case KeyAction::kBegin:
      go(0.0);
      return true;
    case KeyAction::kEnd:
      go(workspace.playback().duration());
      return true;
    case KeyAction::kEdgeBack:
      JumpToEdge(workspace, -1);
      return true;
    case KeyAction::kEdgeOn:
      JumpToEdge(workspace, 1);
      return true;
    case KeyAction::kNearer:
      Zoom(scale_, 0.8, scale_.XOf(workspace.playback().time()));
      return true;
    case KeyAction::kFurther:
      Zoom(scale_, 1.25, scale_.XOf(workspace.playback().time()));
      return true;
    case KeyAction::kFit:
      ZoomToFit(scale_, workspace.playback().duration());
      return true;
    default:
      return false;
  }
}

bool TimelinePanel::HandleEditKey(editor::Workspace& workspace,
                                  EditorActions& actions,
                                  KeyAction action,
                                  bool shift) {
  switch (action) {
    case KeyAction::kAdd:
      open_add_ = true;
      return true;
    case KeyAction::kMarker:
      Add(workspace, LaneKind::kMarkers, "");
      return true;
    case KeyAction::kSnap:
      snap_ = !snap_;
      return true;
    case KeyAction::kRipple:
      ripple_ = !ripple_;
      return true;
    case KeyAction::kTrimBegin:
      TrimToPlayhead(workspace, selection_, items_, true, ripple_);
      return true;
    case KeyAction::kTrimEnd:
      TrimToPlayhead(workspace, selection_, items_, false, ripple_);
      return true;
    case KeyAction::kItemBack:
      ShiftSelected(workspace, selection_, items_, shift ? -1.0 : -kNudge, ripple_);
      return true;
    case KeyAction::kItemOn:
      ShiftSelected(workspace, selection_, items_, shift ? 1.0 : kNudge, ripple_);
      return true;
    case KeyAction::kCut:
      CopySelected(workspace, selection_);
      DeleteSelected(workspace, selection_, items_, ripple_);
      return true;
    case KeyAction::kCopy:
      CopySelected(workspace, selection_);
      return true;
    case KeyAction::kPaste:
      PasteCopied(workspace, selection_);
      return true;
    case KeyAction::kDuplicate:
      DuplicateSelected(workspace, selection_, items_);
      return true;
    case KeyAction::kDelete:
      DeleteSelected(workspace, selection_, items_, ripple_);
      return true;
    case KeyAction::kGoToScript:
      GoToScript(workspace, actions);
      return true;
    default:
      return false;
  }
}

void TimelinePanel::HandleKeys(editor::Workspace& workspace, Input& input, EditorActions& actions) {
  if (input.focus != Focus::kTimeline || ImGui::GetIO().WantTextInput ||
      workspace.project().script().timeline() == nullptr) {
    return;
  }
  Refresh(workspace);
  std::erase_if(input.keys, [&](const KeyPress& press) {
    const KeyAction action = ActionOf(KeyScope::kTimeline, press);
    const bool shift = (press.modifiers & GLFW_MOD_SHIFT) != 0;
    return HandleTimeKey(workspace, action, shift) ||
           HandleSelectionKey(workspace, action, shift) ||
           HandleEditKey(workspace, actions, action, shift);
  });
}

}  // namespace lararium::panels
