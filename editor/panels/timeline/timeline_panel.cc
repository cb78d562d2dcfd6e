#include "editor/panels/timeline/timeline_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "editor/panels/inspector/timeline_inspector.h"
#include "editor/panels/timeline/timeline_commands.h"
#include "editor/panels/timeline/timeline_draw.h"
#include "editor/panels/timeline/timeline_labels.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/palette.h"
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
constexpr float kRuler = 26.0f;
constexpr float kGutter = 176.0f;
constexpr float kInspector = 300.0f;

bool ToggleButton(const std::string& label, bool& on, const std::string& tip) {
  ImGui::PushStyleColor(ImGuiCol_Button, on ? Colours().chosen : Colours().frame);
  const bool pressed = ImGui::Button(label.c_str());
  ImGui::PopStyleColor();
  if (pressed) {
    on = !on;
  }
  Tip(tip);
  return pressed;
}

}  // namespace

// ---- Content ----

void TimelinePanel::Refresh(const editor::Workspace& workspace) {
  const TimelineLayout::Change change = layout_.Refresh(workspace);
  if (change.rows) {
    items_.Clear();
    if (change.run) {
      selection_.ClearBlock();
    }
    selection_.KeepValid(workspace.project().script().timeline());
  }
}

editor::TimeSpan TimelinePanel::Shown(const editor::Workspace& workspace,
                                      const TimelineItem& item) {
  editor::TimeSpan span = items_.SpanOf(workspace, item);
  if (drag_.by != 0.0 && editor::Contains(selection_.items(), item)) {
    if (drag_.kind == Drag::Kind::kMove) {
      span.begin += drag_.by;
      span.end += drag_.by;
    } else if (drag_.kind == Drag::Kind::kTrimBegin) {
      span.begin =
          std::clamp(span.begin + drag_.by, 0.0, std::max(span.end - editor::kShortest, 0.0));
    } else if (drag_.kind == Drag::Kind::kTrimEnd) {
      span.end = std::max(span.end + drag_.by, span.begin + editor::kShortest);
    }
  }
  return span;
}

std::pair<float, float> TimelinePanel::Extent(const editor::TimeSpan& span) const {
  const float x0 = scale_.XOf(span.begin);
  return {x0, std::max(scale_.XOf(span.end), x0 + Px(kLeastItem))};
}

// ---- Drawing ----

void TimelinePanel::DrawVoiceOf(const editor::Workspace& workspace,
                                const std::string& line,
                                double begin,
                                const ImVec2& from,
                                const ImVec2& to,
                                ImU32 colour,
                                ImDrawList& draw) const {
  const editor::DramaRun* run = workspace.dry_run().newest();
  const editor::StageWords::Line* voice = run != nullptr ? run->words.FindLine(line) : nullptr;
  if (voice != nullptr && !voice->peaks.empty()) {
    DrawVoice(draw, scale_,
              {voice->peaks, editor::StageWords::Line::kPeaksPerSecond, voice->visemes}, begin,
              from, to, colour);
  }
}

void TimelinePanel::DrawItems(const editor::Workspace& workspace,
                              const TimelineRow& row,
                              float top,
                              float height,
                              const Hit& hit,
                              ImDrawList& draw) {
  const TimelineText& text = *workspace.project().script().timeline();
  const ImVec4 colour = LaneColour(row.lane);
  const float y0 = top + Px(2);
  const float y1 = top + height - Px(2);
  const double to = scale_.last();
  for (const size_t lane : row.lanes) {
    const TimelineLane& in = text.lanes()[lane];
    found_.clear();
    text.Query(lane, std::max(scale_.first - TimelineItems::kLongNatural, 0.0), to, found_);
    float filled_to = scale_.left - 1.0f;
    for (const uint32_t number : found_) {
      const TimelineItem item{lane, number};
      const bool selected = editor::Contains(selection_.items(), item);
      // Where several items lie within one pixel, only one is drawn.
      const double end = in.at[number] + std::max(in.length[number], 0.0);
      const float plain_end = std::max(scale_.XOf(end), scale_.XOf(in.at[number]) + 1.0f);
      if (!selected && plain_end <= filled_to) {
        continue;
      }
      const bool dense = scale_.seconds_per_px > 0.5 && in.size() > 5000;
      const editor::TimeSpan span =
          dense && !selected ? editor::TimeSpan{in.at[number], end} : Shown(workspace, item);
      auto [x0, x1] = Extent(span);
      if (dense && !selected) {
        x1 = std::max(scale_.XOf(span.end), x0 + 1.0f);
      }
      filled_to = std::max(filled_to, x1 - (dense ? 0.0f : Px(kLeastItem)));
      if (x1 < scale_.left) {
        continue;
      }
      ItemLook look;
      look.selected = selected;
      look.hovered = hit.item && *hit.item == item;
      look.open_end = in.length[number] <= 0.0;
      const float width = x1 - x0;
      const bool labelled = width > Px(24);
      DrawItem(draw, ImVec2(std::max(x0, scale_.left - Px(8)), y0), ImVec2(x1 - 1.0f, y1), colour,
               labelled ? WithIcon(IconOf(row.lane), items_.FaceOf(workspace, item).label)
                        : std::string(),
               look);
      if (row.lane == LaneKind::kMarkers) {
        const std::string& name = items_.FaceOf(workspace, item).label;
        draw.AddText(ImVec2(x1 + Px(3), y0 + Px(1)), Packed(Colours().text), name.c_str());
      }
      if (row.lane == LaneKind::kSpeech && labelled) {
        DrawVoiceOf(workspace, items_.FaceOf(workspace, item).line, span.begin,
                    ImVec2(x0, y0 + Px(19)), ImVec2(x1 - 1.0f, y1), Packed(Colours().window, 0.75f),
                    draw);
      }
    }
  }
}

void TimelinePanel::DrawBlocks(const editor::Workspace& workspace,
                               const TimelineRow& row,
                               float top,
                               float height,
                               const Hit& hit,
                               ImDrawList& draw) {
  if (workspace.dry_run().newest() == nullptr) {
    return;
  }
  const std::vector<TaskRecord>& tasks = workspace.dry_run().newest()->tasks;
  const ImVec4 colour = LaneColour(row.lane);
  found_.clear();
  row.index.Query(scale_.first, scale_.last(), found_);
  for (const uint32_t number : found_) {
    const uint32_t block = row.blocks[number];
    const TaskRecord& task = tasks[block];
    const auto [x0, x1] = Extent({task.began, task.ended});
    ItemLook look;
    look.scripted = true;
    look.failed = task.failed && !task.expected;
    look.selected = selection_.block() == block;
    look.hovered = hit.block == block;
    DrawItem(draw, ImVec2(std::max(x0, scale_.left - Px(8)), top + Px(3)),
             ImVec2(x1 - 1.0f, top + height - Px(3)), colour,
             x1 - x0 > Px(24) ? WithIcon(IconOf(row.lane), BlockLabel(task, row.of_object))
                              : std::string(),
             look);
    if (row.lane == LaneKind::kSpeech && x1 - x0 > Px(24)) {
      DrawVoiceOf(workspace, BlockLabel(task, false), task.began, ImVec2(x0, top + Px(22)),
                  ImVec2(x1 - 1.0f, top + height - Px(3)), Packed(colour, 0.85f), draw);
    }
  }
}

void TimelinePanel::DrawGutter(const editor::Workspace& workspace,
                               const TimelineRow& row,
                               const ImVec2& at,
                               float width) const {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float text_y = at.y + 0.5f * (Px(TimelineLayout::kRow) - ImGui::GetTextLineHeight());
  const ImVec4 clip(at.x, at.y, at.x + width - Px(6), at.y + Px(TimelineLayout::kRow));
  const auto write = [&](float x, const ImVec4& colour, const std::string& text) {
    draw.AddText(nullptr, 0.0f, ImVec2(at.x + x, text_y), Packed(colour), text.c_str(), nullptr,
                 0.0f, &clip);
  };
  if (row.kind != TimelineRow::Kind::kHeading) {
    draw.AddRectFilled(ImVec2(at.x + Px(14), at.y + Px(5)),
                       ImVec2(at.x + Px(17), at.y + Px(TimelineLayout::kRow - 5)),
                       Packed(LaneColour(row.lane)), Px(1));
    const bool scripted = row.kind == TimelineRow::Kind::kBlocks;
    const std::string title = row.of_object ? Tr("used")
                              : scripted    ? std::string(LaneTitle(row.lane)) + ", " + Tr("script")
                                            : LaneTitle(row.lane);
    write(Px(22), Colours().dim, WithIcon(IconOf(row.lane), title));
    return;
  }
  const bool folded = layout_.IsFolded(row);
  const ImVec2 c(at.x + Px(11), at.y + Px(0.5f * TimelineLayout::kRow));
  if (folded) {
    draw.AddTriangleFilled(ImVec2(c.x - Px(3), c.y - Px(5)), ImVec2(c.x - Px(3), c.y + Px(5)),
                           ImVec2(c.x + Px(4), c.y), Packed(Colours().dim));
  } else {
    draw.AddTriangleFilled(ImVec2(c.x - Px(5), c.y - Px(3)), ImVec2(c.x + Px(5), c.y - Px(3)),
                           ImVec2(c.x, c.y + Px(4)), Packed(Colours().dim));
  }
  const std::string group =
      row.of_object ? row.group : workspace.project().document().PersonLabel(row.group);
  write(Px(22), Colours().text, group.empty() ? Tr("Stage") : group);
}

void TimelinePanel::DrawRow(const editor::Workspace& workspace,
                            const TimelineRow& row,
                            float top,
                            float height,
                            const Hit& hit,
                            ImDrawList& draw) {
  if (row.kind == TimelineRow::Kind::kHeading) {
    draw.AddRectFilled(ImVec2(scale_.left - Px(kGutter), top + Px(1)),
                       ImVec2(scale_.left + scale_.width, top + height - Px(1)),
                       Packed(Colours().frame, 0.45f));
    return;
  }
  draw.AddLine(ImVec2(scale_.left, top + height), ImVec2(scale_.left + scale_.width, top + height),
               Packed(Colours().line, 0.5f));
  draw.PushClipRect(ImVec2(scale_.left, top - 1), ImVec2(scale_.left + scale_.width, top + height),
                    true);
  if (row.kind == TimelineRow::Kind::kItems) {
    DrawItems(workspace, row, top, height, hit, draw);
  } else {
    DrawBlocks(workspace, row, top, height, hit, draw);
  }
  draw.PopClipRect();
}

void TimelinePanel::DrawRuler(editor::Workspace& workspace, float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::Dummy(ImVec2(Px(kGutter), height));
  ImGui::SameLine(0.0f, 0.0f);
  scale_.left = at.x + Px(kGutter);
  scale_.width =
      std::max(ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize, Px(80));
  ImGui::InvisibleButton("ruler", ImVec2(scale_.width, height));
  if (ImGui::IsItemHovered()) {
    HandleWheel();
    if (!ImGui::IsItemActive()) {
      ImGui::SetTooltip("%s", Tr("Drag to go to another time. Ctrl and wheel: zoom."));
    }
  }
  if (ImGui::IsItemActive()) {
    workspace.playback().SetPlaying(false);
    const RulerStep step = ChooseStep(scale_.seconds_per_px, Px(76));
    double time = std::max(scale_.TimeAt(ImGui::GetIO().MousePos.x), 0.0);
    if (ImGui::GetIO().KeyCtrl) {
      time = Snap(time, {}, step.seconds / step.parts, 1e9);
    }
    workspace.playback().SetTime(time);
  }
  draw.PushClipRect(ImVec2(scale_.left, at.y), ImVec2(scale_.left + scale_.width, at.y + height),
                    true);
  DrawRulerTicks(draw, scale_, at.y, height);
  if (drag_.snapped_to >= 0.0) {
    const float x = scale_.XOf(drag_.snapped_to);
    draw.AddLine(ImVec2(x, at.y), ImVec2(x, at.y + height), Packed(Colours().text, 0.8f), Px(1));
  }
  DrawPlayheadHandle(draw, scale_.XOf(workspace.playback().time()), at.y, height);
  draw.PopClipRect();
}

// Scrolls by the smallest amount that shows the row of the last selection.
void TimelinePanel::ScrollToChosen() {
  const std::optional<TimelineStop> chosen = selection_.Last();
  for (size_t i = 0; i < layout_.shown().size() && chosen; ++i) {
    if (HasStop(*layout_.shown()[i], *chosen)) {
      const float lowest = layout_.Top(i + 1) - ImGui::GetWindowHeight();
      ImGui::SetScrollY(
          std::clamp(ImGui::GetScrollY(), std::min(lowest, layout_.Top(i)), layout_.Top(i)));
      return;
    }
  }
}

void TimelinePanel::DrawRows(editor::Workspace& workspace, Input& input, EditorActions& actions) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::BeginChild("rows", ImVec2(0, 0), false,
                    ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_AlwaysVerticalScrollbar);
  ImGui::PopStyleVar();
  if (std::exchange(scroll_to_chosen_, false)) {
    ScrollToChosen();
  }
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 view = ImGui::GetWindowPos();
  const ImVec2 view_size = ImGui::GetWindowSize();
  const float height = layout_.height();
  ImGui::InvisibleButton("items",
                         ImVec2(Px(kGutter) + scale_.width, std::max(height, view_size.y - Px(2))),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered();
  HandleMouse(workspace, input, actions, origin.y, hovered);
  const Hit hit = hovered && drag_.kind == Drag::Kind::kNone
                      ? HitAt(workspace, ImGui::GetIO().MousePos, origin.y)
                      : Hit();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(ImVec2(scale_.left, view.y),
                    ImVec2(scale_.left + scale_.width, view.y + view_size.y), true);
  DrawGrid(draw, scale_, view.y, view.y + view_size.y);
  const float end = scale_.XOf(workspace.playback().duration());
  draw.AddRectFilled(ImVec2(std::max(end, scale_.left), view.y),
                     ImVec2(scale_.left + scale_.width, view.y + view_size.y),
                     Packed(Colours().window, 0.45f));
  draw.PopClipRect();
  for (size_t i = static_cast<size_t>(std::max(layout_.RowAt(view.y - origin.y), 0));
       i < layout_.shown().size(); ++i) {
    const float top = origin.y + layout_.Top(i);
    if (top > view.y + view_size.y) {
      break;
    }
    DrawRow(workspace, *layout_.shown()[i], top, layout_.Top(i + 1) - layout_.Top(i), hit, draw);
    DrawGutter(workspace, *layout_.shown()[i], ImVec2(view.x, top), Px(kGutter));
  }
  draw.PushClipRect(ImVec2(scale_.left, view.y),
                    ImVec2(scale_.left + scale_.width, view.y + view_size.y), true);
  if (drag_.snapped_to >= 0.0) {
    const float x = scale_.XOf(drag_.snapped_to);
    draw.AddLine(ImVec2(x, view.y), ImVec2(x, view.y + view_size.y), Packed(Colours().text, 0.8f),
                 Px(1));
  }
  if (drag_.kind == Drag::Kind::kBox && drag_.moved) {
    const ImVec2 a(scale_.XOf(drag_.from), origin.y + drag_.from_y);
    const ImVec2& b = ImGui::GetIO().MousePos;
    const ImVec2 from(std::min(a.x, b.x), std::min(a.y, b.y));
    const ImVec2 to(std::max(a.x, b.x), std::max(a.y, b.y));
    draw.AddRectFilled(from, to, Packed(Colours().accent, 0.15f));
    draw.AddRect(from, to, Packed(Colours().accent, 0.8f));
  }
  DrawPlayhead(draw, scale_.XOf(workspace.playback().time()), view.y, view.y + view_size.y);
  draw.PopClipRect();
  if (layout_.shown().empty() ||
      (layout_.rows().size() <= 1 && workspace.project().document().cast.empty())) {
    const char* text = Tr("Nobody is on the stage yet. Add a person in the list at the left.");
    draw.AddText(ImVec2(scale_.left + Px(24), view.y + Px(34)), Packed(Colours().dim), text);
  }
  if (std::exchange(open_context_, false)) {
    ImGui::OpenPopup("item menu");
  }
  if (std::exchange(open_add_, false)) {
    ImGui::OpenPopup("add menu");
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(Px(8), Px(7)));  // The spacing of menus.
  DrawContextMenu(workspace, actions);
  if (ImGui::BeginPopup("add menu")) {
    DrawAddMenu(workspace);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void TimelinePanel::DrawKindMenu(editor::Workspace& workspace, const std::string& actor) {
  for (const drama::LaneSpec& lane : drama::LaneSpecs()) {
    if (lane.of_actor == !actor.empty() &&
        ImGui::MenuItem(WithIcon(IconOf(lane.kind), ItemTitle(lane.kind)).c_str())) {
      Add(workspace, lane.kind, actor);
    }
  }
}

void TimelinePanel::DrawAddMenu(editor::Workspace& workspace) {
  DimText(Text(Tr("At %s"), FormatTime(workspace.playback().time(), 0.01).c_str()));
  for (const editor::CastDocument& member : workspace.project().document().cast) {
    if (ImGui::BeginMenu(WithIcon(Icon::kPerson, member.label()).c_str())) {
      DrawKindMenu(workspace, member.name);
      ImGui::EndMenu();
    }
  }
  ImGui::Separator();
  DrawKindMenu(workspace, "");
}

void TimelinePanel::DrawContextMenu(editor::Workspace& workspace, EditorActions& actions) {
  if (!ImGui::BeginPopup("item menu")) {
    return;
  }
  const bool any = selection_.HasItems();
  if (context_.block) {
    if (ImGui::MenuItem(Tr("Go to the script"), Tr("Enter"))) {
      selection_.SelectBlock(*context_.block, context_.group);
      GoToScript(workspace, actions);
    }
  } else if (context_.item) {
    if (ImGui::MenuItem(Tr("Cut"), "Ctrl+X", false, any)) {
      CopySelected(workspace, selection_);
      DeleteSelected(workspace, selection_, items_, ripple_);
    }
    if (ImGui::MenuItem(Tr("Copy"), "Ctrl+C", false, any)) {
      CopySelected(workspace, selection_);
    }
    if (ImGui::MenuItem(Tr("Duplicate"), "Ctrl+D", false, any)) {
      DuplicateSelected(workspace, selection_, items_);
    }
    if (ImGui::MenuItem(Tr("Delete"), TrIn("key", "Delete"), false, any)) {
      DeleteSelected(workspace, selection_, items_, ripple_);
    }
    ImGui::Separator();
    if (ImGui::MenuItem(Tr("Begin at the playhead"), "[", false, any)) {
      TrimToPlayhead(workspace, selection_, items_, true, ripple_);
    }
    if (ImGui::MenuItem(Tr("End at the playhead"), "]", false, any)) {
      TrimToPlayhead(workspace, selection_, items_, false, ripple_);
    }
    ImGui::Separator();
    if (ImGui::MenuItem(Tr("Go to the script"), Tr("Enter"))) {
      GoToScript(workspace, actions);
    }
  } else {
    if (ImGui::MenuItem(Tr("Paste"), "Ctrl+V")) {
      PasteCopied(workspace, selection_);
    }
    ImGui::Separator();
    const TimelineRow* row =
        context_.row >= 0 && context_.row < static_cast<int>(layout_.shown().size())
            ? &layout_.Shown(context_.row)
            : nullptr;
    if (row != nullptr && !row->of_object) {
      DimText(row->group.empty() ? Tr("Stage")
                                 : workspace.project().document().PersonLabel(row->group));
      DrawKindMenu(workspace, row->group);
    } else {
      DrawAddMenu(workspace);
    }
  }
  ImGui::EndPopup();
}

// ---- The panel ----

void TimelinePanel::DrawTools(editor::Workspace& workspace, Input& input) {
  PlayButton(workspace);
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(FormatTime(workspace.playback().time(), 0.01).c_str());
  ImGui::SameLine(0.0f, Px(4));
  DimText("/ " + FormatTime(workspace.playback().duration(), 1.0));
  ImGui::SameLine(0.0f, Px(16));
  ImGui::BeginDisabled(workspace.project().script().timeline() == nullptr);
  if (ImGui::Button(WithIcon(Icon::kAdd, Tr("Add")).c_str())) {
    open_add_ = true;
    input.focus = Focus::kTimeline;
  }
  ImGui::EndDisabled();
  Tip(WithKey(Tr("Adds an item at the playhead"), KeyAction::kAdd));
  const std::string snap = WithIcon(Icon::kSnap, Tr("Snap"));
  const std::string ripple = WithIcon(Icon::kRipple, Tr("Ripple"));
  const std::string fit = WithIcon(Icon::kFit, Tr("Fit"));
  if (FitsBeside(std::array{snap.c_str(), ripple.c_str(), fit.c_str(), "   "})) {
    DrawSwitches(workspace);
  } else {
    DrawSwitchMenu(workspace);
  }
}

void TimelinePanel::DrawSwitches(const editor::Workspace& workspace) {
  ImGui::SameLine();
  ToggleButton(WithIcon(Icon::kSnap, Tr("Snap")), snap_,
               WithKey(Tr("Items are drawn to others, to the playhead and to the grid; not while "
                          "Alt is held"),
                       KeyAction::kSnap));
  ImGui::SameLine();
  ToggleButton(WithIcon(Icon::kRipple, Tr("Ripple")), ripple_,
               WithKey(Tr("What comes later moves along"), KeyAction::kRipple));
  ImGui::SameLine();
  if (ImGui::Button(WithIcon(Icon::kFit, Tr("Fit")).c_str())) {
    ZoomToFit(scale_, workspace.playback().duration());
  }
  Tip(WithKey(Tr("Shows all of the drama; Ctrl and the wheel zoom"), KeyAction::kFit));
}

void TimelinePanel::DrawSwitchMenu(const editor::Workspace& workspace) {
  ImGui::SameLine();
  if (ImGui::Button("\xe2\x80\xa6")) {
    ImGui::OpenPopup("switches");
  }
  Tip(Tr("Snap, ripple and fit"));
  if (ImGui::BeginPopup("switches")) {
    ImGui::MenuItem(Tr("Snap"), KeyText(KeyAction::kSnap).c_str(), &snap_);
    ImGui::MenuItem(Tr("Ripple"), KeyText(KeyAction::kRipple).c_str(), &ripple_);
    if (ImGui::MenuItem(Tr("Fit"), KeyText(KeyAction::kFit).c_str())) {
      ZoomToFit(scale_, workspace.playback().duration());
    }
    ImGui::EndPopup();
  }
}

void TimelinePanel::Show(editor::Workspace& workspace, Input& input, EditorActions& actions) {
  Refresh(workspace);
  const auto asked = std::exchange(asked_, std::nullopt);
  if (const TimelineText* text = workspace.project().script().timeline();
      asked && text != nullptr) {
    editor::ItemSet still_there = {*asked};
    editor::KeepValid(*text, still_there);
    for (const TimelineItem& item : still_there) {
      Choose(*text, item);
      layout_.LayOut();
    }
  }
  const ImVec2 available = ImGui::GetContentRegionAvail();
  const float inspector = std::min(Px(kInspector), 0.4f * available.x);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::BeginChild("canvas", ImVec2(available.x - inspector - Px(12), available.y), false,
                    ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoScrollbar);
  if (!fitted_ && workspace.playback().duration() > 0.0 && scale_.width > 0.0f) {
    fitted_ = true;
    ZoomToFit(scale_, std::min(workspace.playback().duration(), 120.0));
  }
  if (workspace.playback().playing() && drag_.kind == Drag::Kind::kNone) {
    ScrollTo(scale_, workspace.playback().time());
  }
  DrawRuler(workspace, Px(kRuler));
  DrawRows(workspace, input, actions);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::SameLine(0.0f, Px(12));
  input.keyboard.Before(Region::kItem);
  ImGui::BeginChild("item", ImVec2(0, available.y));
  input.keyboard.Begin(Region::kItem);
  DrawTimelineInspector(workspace, actions, selection_.items(), selection_.block(), new_language_);
  input.keyboard.End(Region::kItem);
  ImGui::EndChild();
}

}  // namespace lararium::panels
