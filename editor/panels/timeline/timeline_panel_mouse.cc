// Mouse input of the timeline: hit testing and drags.

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/panels/timeline/timeline_draw.h"
#include "editor/panels/timeline/timeline_labels.h"
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

}  // namespace

TimelinePanel::Hit TimelinePanel::HitAt(const editor::Workspace& workspace,
                                        const ImVec2& mouse,
                                        float rows_top) {
  Hit hit;
  hit.row = RowAt(mouse.y - rows_top);
  if (hit.row < 0 || mouse.x < scale_.left) {
    return hit;
  }
  const TimelineRow& row = *shown_[static_cast<size_t>(hit.row)];
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
      workspace.project().script().timeline()->Query(lane, before - kLongNatural, after, found_);
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
        hit.part = Hit::Part::kBody;
      }
    }
  }
  return hit;
}

void TimelinePanel::BeginDrag(editor::Workspace& workspace,
                              EditorState& state,
                              const Hit& hit,
                              float rows_top) {
  const ImGuiIO& io = ImGui::GetIO();
  state.focus = Focus::kTimeline;
  drag_ = {};
  drag_.from = scale_.TimeAt(io.MousePos.x);
  drag_.from_y = io.MousePos.y - rows_top;
  drag_.before = selection_;
  const bool adds = io.KeyCtrl || io.KeyShift;
  if (hit.block) {
    selection_.clear();
    block_ = hit.block;
    block_group_ = KeyOfGroup(*shown_[static_cast<size_t>(hit.row)]);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      GoToScript(workspace, state);
    }
    return;
  }
  block_.reset();
  if (!hit.item) {
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && hit.row >= 0 &&
        shown_[static_cast<size_t>(hit.row)]->kind == TimelineRow::Kind::kItems) {
      const TimelineRow& row = *shown_[static_cast<size_t>(hit.row)];
      workspace.playback().SetTime(std::max(drag_.from, 0.0));
      Add(workspace, row.lane, row.group);
      return;
    }
    drag_.kind = Drag::Kind::kBox;
    if (!adds) {
      selection_.clear();
    }
    return;
  }
  if (adds) {
    editor::Toggle(selection_, *hit.item);
    return;
  }
  if (!editor::Contains(selection_, *hit.item)) {
    selection_ = {*hit.item};
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
      if (!editor::Contains(selection_, {lane, i})) {
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
    const double allowed = editor::ClampMove(text, selection_, by, ripple_);
    drag_.snapped_to = allowed == by ? drag_.snapped_to : -1.0;
    by = allowed;
  }
  drag_.by = by;
}

void TimelinePanel::SelectBox(const editor::Workspace& workspace, double to, float y) {
  selection_ = drag_.before;
  if (!ImGui::GetIO().KeyCtrl && !ImGui::GetIO().KeyShift) {
    selection_.clear();
  }
  const double begin = std::min(drag_.from, to);
  const double end = std::max(drag_.from, to);
  const float low = std::min(drag_.from_y, y);
  const float high = std::max(drag_.from_y, y);
  for (size_t r = 0; r < shown_.size(); ++r) {
    const TimelineRow& row = *shown_[r];
    if (tops_[r] > high || tops_[r + 1] < low) {
      continue;
    }
    for (const size_t lane : row.lanes) {
      found_.clear();
      workspace.project().script().timeline()->Query(lane, begin - kLongNatural, end, found_);
      for (const uint32_t item : found_) {
        if (Shown(workspace, {lane, item}).end >= begin) {
          selection_.push_back({lane, item});
        }
      }
    }
  }
  std::sort(selection_.begin(), selection_.end());
  selection_.erase(std::unique(selection_.begin(), selection_.end()), selection_.end());
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

std::vector<double> TimelinePanel::Naturals(const editor::Workspace& workspace) {
  std::vector<double> naturals;
  for (const TimelineItem& item : selection_) {
    naturals.push_back(std::max(FaceOf(workspace, item).natural, editor::kShortest));
  }
  return naturals;
}

std::string TimelinePanel::NameOfSelection(const editor::Workspace& workspace) {
  if (selection_.size() == 1) {
    const std::string& label = FaceOf(workspace, selection_.front()).label;
    return label.empty() ? Tr("an item") : label;
  }
  return TrCount("%d item", "%d items", static_cast<int>(selection_.size()));
}

void TimelinePanel::EndDrag(editor::Workspace& workspace) {
  const Drag drag = std::exchange(drag_, Drag());
  if (!drag.moved || drag.by == 0.0 || workspace.project().script().timeline() == nullptr) {
    if (!drag.moved && drag.kind == Drag::Kind::kMove) {
      selection_ = {drag.grabbed};  // A click on one of several selected items.
    }
    return;
  }
  const std::string name = NameOfSelection(workspace);
  const std::vector<double> naturals = Naturals(workspace);
  if (drag.kind == Drag::Kind::kMove) {
    workspace.project().EditTimeline(Sentence("move %s", {name}), [&](TimelineText& text) {
      return editor::MoveItems(text, selection_, drag.by, ripple_);
    });
  } else if (drag.kind == Drag::Kind::kTrimBegin) {
    workspace.project().EditTimeline(Sentence("trim %s", {name}), [&](TimelineText& text) {
      return editor::TrimBegins(text, selection_, naturals, drag.by);
    });
  } else if (drag.kind == Drag::Kind::kTrimEnd) {
    workspace.project().EditTimeline(Sentence("trim %s", {name}), [&](TimelineText& text) {
      return editor::TrimEnds(text, selection_, naturals, drag.by, ripple_);
    });
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
    ImGui::SetScrollY(ImGui::GetScrollY() - io.MouseWheel * Px(2 * kRow));
  }
}

void TimelinePanel::HandleMouse(editor::Workspace& workspace,
                                EditorState& state,
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
      state.focus = Focus::kTimeline;
      if (hit.item && !editor::Contains(selection_, *hit.item)) {
        selection_ = {*hit.item};
        block_.reset();
      }
      if (hit.block) {
        selection_.clear();
        block_ = hit.block;
        block_group_ = KeyOfGroup(*shown_[static_cast<size_t>(hit.row)]);
      }
      context_ = hit;
      open_context_ = true;
      drag_ = {};
    } else if (in_gutter) {
      state.focus = Focus::kTimeline;
      if (hit.row >= 0 &&
          shown_[static_cast<size_t>(hit.row)]->kind == TimelineRow::Kind::kHeading) {
        Fold(*shown_[static_cast<size_t>(hit.row)]);
      }
      drag_ = {};
    } else {
      BeginDrag(workspace, state, hit, rows_top);
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
      shown_[static_cast<size_t>(hit.row)]->kind == TimelineRow::Kind::kHeading) {
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
    title = std::string(ItemTitle(lane.kind)) + ": " + FaceOf(workspace, *hit.item).label;
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

}  // namespace lararium::panels
