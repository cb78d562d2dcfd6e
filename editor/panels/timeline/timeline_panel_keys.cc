// The commands of the timeline and their keys.

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/panels/timeline/timeline_draw.h"
#include "editor/panels/timeline/timeline_new_item.h"
#include "editor/panels/timeline/timeline_panel.h"
#include "editor/panels/widgets/text.h"

namespace lararium::panels {

using drama::LaneKind;
using drama::TaskRecord;
using drama::TimelineItem;
using drama::TimelineLane;
using drama::TimelineText;

namespace {

constexpr double kFrame = 1.0 / 30.0;  // Seconds; the step of the keys.
constexpr double kNudge = 0.1;

}  // namespace

void TimelinePanel::Add(editor::Workspace& workspace, LaneKind kind, const std::string& actor) {
  editor::ItemSet added;
  const double at = std::round(workspace.playback().time() * 100.0) / 100.0;
  const bool done = workspace.project().EditTimeline(
      Sentence("add %s", {std::string(ItemTitle(kind))}), [&](TimelineText& text) {
        return editor::AddItem(text, kind, actor, NewFields(workspace, kind, actor, at), added);
      });
  if (done) {
    selection_ = added;
    block_.reset();
    folded_.erase("person " + actor);
  }
}

void TimelinePanel::Delete(editor::Workspace& workspace) {
  if (selection_.empty()) {
    return;
  }
  const std::string name = NameOfSelection(workspace);
  const bool done = workspace.project().EditTimeline(
      Sentence("delete %s", {name}),
      [&](TimelineText& text) { return editor::DeleteItems(text, selection_, ripple_); });
  if (done) {
    selection_.clear();
  }
}

void TimelinePanel::Copy(const editor::Workspace& workspace) {
  if (!selection_.empty()) {
    ImGui::SetClipboardText(
        editor::FormatCopied(
            editor::CopyItems(*workspace.project().script().timeline(), selection_))
            .c_str());
  }
}

void TimelinePanel::Paste(editor::Workspace& workspace) {
  const char* clipboard = ImGui::GetClipboardText();
  const auto items = clipboard != nullptr ? editor::ParseCopied(clipboard) : std::nullopt;
  if (!items || items->empty()) {
    return;
  }
  editor::ItemSet added;
  const bool done = workspace.project().EditTimeline(Sentence("paste"), [&](TimelineText& text) {
    return editor::PasteItems(text, *items, workspace.playback().time(), added);
  });
  if (done) {
    selection_ = added;
  }
}

void TimelinePanel::Duplicate(editor::Workspace& workspace) {
  if (selection_.empty()) {
    return;
  }
  const TimelineText& text = *workspace.project().script().timeline();
  double end = 0.0;
  for (const TimelineItem& item : selection_) {
    end = std::max(end, Shown(workspace, item).end);
  }
  const std::vector<editor::CopiedItem> copied = editor::CopyItems(text, selection_);
  const double at = std::max(end, editor::SpanOf(text, selection_).begin + 0.5);
  editor::ItemSet added;
  const bool done = workspace.project().EditTimeline(
      Sentence("duplicate %s", {NameOfSelection(workspace)}),
      [&](TimelineText& changed) { return editor::PasteItems(changed, copied, at, added); });
  if (done) {
    selection_ = added;
  }
}

void TimelinePanel::Nudge(editor::Workspace& workspace, double seconds) {
  if (!selection_.empty()) {
    workspace.project().EditTimeline(
        Sentence("move %s", {NameOfSelection(workspace)}),
        [&](TimelineText& text) { return editor::MoveItems(text, selection_, seconds, ripple_); });
  }
}

void TimelinePanel::TrimToPlayhead(editor::Workspace& workspace, bool begins) {
  if (selection_.empty()) {
    return;
  }
  const std::vector<double> naturals = Naturals(workspace);
  const editor::TimeSpan span = Shown(workspace, selection_.front());
  const Sentence name("trim %s", {NameOfSelection(workspace)});
  workspace.project().EditTimeline(name, [&](TimelineText& text) {
    return begins ? editor::TrimBegins(text, selection_, naturals,
                                       workspace.playback().time() - span.begin)
                  : editor::TrimEnds(text, selection_, naturals,
                                     workspace.playback().time() - span.end, ripple_);
  });
}

void TimelinePanel::SelectAll(const editor::Workspace& workspace) {
  selection_.clear();
  block_.reset();
  const auto lanes = workspace.project().script().timeline()->lanes();
  for (size_t lane = 0; lane < lanes.size(); ++lane) {
    for (size_t item = 0; item < lanes[lane].size(); ++item) {
      selection_.push_back({lane, item});
    }
  }
}

void TimelinePanel::Choose(const TimelineText& text, TimelineItem item) {
  const TimelineLane& lane = text.lanes()[item.lane];
  selection_ = {item};
  last_ = item;
  block_.reset();
  folded_.erase("person " + lane.actor);
  ScrollTo(scale_, lane.at[item.item]);
  scroll_to_chosen_ = true;
}

std::optional<TimelineStop> TimelinePanel::ChosenLast() const {
  if (last_ && editor::Contains(selection_, *last_)) {
    return TimelineStop{last_};
  }
  if (!selection_.empty()) {
    return TimelineStop{selection_.back()};
  }
  return block_ ? std::optional(TimelineStop{std::nullopt, *block_, block_group_}) : std::nullopt;
}

bool TimelinePanel::HasStop(const TimelineRow& row, const TimelineStop& stop) {
  return stop.item
             ? std::find(row.lanes.begin(), row.lanes.end(), stop.item->lane) != row.lanes.end()
             : KeyOfGroup(row) == stop.group &&
                   std::find(row.blocks.begin(), row.blocks.end(), stop.block) != row.blocks.end();
}

void TimelinePanel::StepSelection(const editor::Workspace& workspace, const TimelineStep& step) {
  const TimelineText& text = *workspace.project().script().timeline();
  const editor::DramaRun* run = workspace.dry_run().newest();
  const std::vector<TimelineLine> lines = LinesOf(
      rows_, text, run != nullptr ? std::span(run->tasks) : std::span<const TaskRecord>(), folded_);
  const std::optional<TimelineStop> from = ChosenLast();
  const std::optional<TimelineStop> to = StepFrom(lines, from, workspace.playback().time(), step);
  if (!to || (step.items && !to->item)) {
    return;
  }
  if (!to->item) {
    selection_.clear();
    block_ = to->block;
    block_group_ = to->group;
    ScrollTo(scale_, to->at);
    scroll_to_chosen_ = true;
    return;
  }
  editor::ItemSet chosen = selection_;
  Choose(text, *to->item);
  if (step.items) {
    Extend(chosen, from ? from->item : std::nullopt, *to->item);
    selection_ = std::move(chosen);
  }
}

void TimelinePanel::Fold(const TimelineRow& row) {
  const std::string key = KeyOfGroup(row);
  if (folded_.erase(key) == 0) {
    folded_.insert(key);
  }
}

void TimelinePanel::FoldChosen() {
  const std::optional<TimelineStop> chosen = ChosenLast();
  const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const TimelineRow& of) {
    return chosen && HasStop(of, *chosen);
  });
  if (row != rows_.end()) {
    Fold(*row);
    scroll_to_chosen_ = true;
  }
}

void TimelinePanel::FoldAll() {
  const bool unfold = std::any_of(rows_.begin(), rows_.end(), [&](const TimelineRow& row) {
    return folded_.contains(KeyOfGroup(row));
  });
  folded_.clear();
  for (const TimelineRow& row : rows_) {
    if (!unfold) {
      folded_.insert(KeyOfGroup(row));
    }
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

void TimelinePanel::GoToScript(const editor::Workspace& workspace, EditorState& state) {
  int line = 0;
  if (!selection_.empty() && workspace.project().script().timeline() != nullptr) {
    line = static_cast<int>(workspace.project().script().timeline()->LineOf(selection_.front()));
  } else if (block_ && workspace.dry_run().newest() != nullptr) {
    line = LineOfPlace(workspace.dry_run().newest()->tasks[*block_].where,
                       workspace.project().paths().Drama().filename().string());
  }
  if (line > 0) {
    state.script_line = line;
    state.bottom = BottomTab::kScript;
  }
}

bool TimelinePanel::HandleSelectionKey(editor::Workspace& workspace, KeyAction action, bool shift) {
  switch (action) {
    case KeyAction::kSelectAll:
      SelectAll(workspace);
      return true;
    case KeyAction::kSelectNone:
      drag_ = {};
      selection_.clear();
      block_.reset();
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
      shift ? FoldAll() : FoldChosen();
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
                                  EditorState& state,
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
      TrimToPlayhead(workspace, true);
      return true;
    case KeyAction::kTrimEnd:
      TrimToPlayhead(workspace, false);
      return true;
    case KeyAction::kItemBack:
      Nudge(workspace, shift ? -1.0 : -kNudge);
      return true;
    case KeyAction::kItemOn:
      Nudge(workspace, shift ? 1.0 : kNudge);
      return true;
    case KeyAction::kCut:
      Copy(workspace);
      Delete(workspace);
      return true;
    case KeyAction::kCopy:
      Copy(workspace);
      return true;
    case KeyAction::kPaste:
      Paste(workspace);
      return true;
    case KeyAction::kDuplicate:
      Duplicate(workspace);
      return true;
    case KeyAction::kDelete:
      Delete(workspace);
      return true;
    case KeyAction::kGoToScript:
      GoToScript(workspace, state);
      return true;
    default:
      return false;
  }
}

void TimelinePanel::HandleKeys(editor::Workspace& workspace, EditorState& state) {
  if (state.focus != Focus::kTimeline || state.bottom != BottomTab::kTimeline ||
      state.dialog != Dialog::kNone || ImGui::GetIO().WantTextInput ||
      workspace.project().script().timeline() == nullptr) {
    return;
  }
  Refresh(workspace);
  std::erase_if(state.keys, [&](const KeyPress& press) {
    const KeyAction action = ActionOf(KeyScope::kTimeline, press);
    const bool shift = (press.modifiers & GLFW_MOD_SHIFT) != 0;
    return HandleTimeKey(workspace, action, shift) ||
           HandleSelectionKey(workspace, action, shift) ||
           HandleEditKey(workspace, state, action, shift);
  });
}

}  // namespace lararium::panels
