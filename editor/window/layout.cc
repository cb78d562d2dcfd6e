#include "editor/window/layout.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "editor/document/titles.h"
#include "editor/panels/dialogs/checks_panel.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/dialogs/messages.h"
#include "editor/panels/dialogs/toolbar.h"
#include "editor/panels/dialogs/tour_card.h"
#include "editor/panels/inspector/inspector.h"
#include "editor/panels/inspector/outliner.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::editor {

namespace {

using panels::BottomTab;
using panels::Focus;
using panels::Px;
using panels::Region;

constexpr float kSplitter = 6.0f;  // Gap between panels, logical pixels.
constexpr float kMinPanel = 160.0f;
constexpr float kMinBottom = 96.0f;
constexpr float kMinViewportWidth = 280.0f;
constexpr float kMinViewportHeight = 320.0f;

// A bar between two panels. Dragging sets `size` to `now` plus the movement times `sign`, in
// logical pixels.
void Splitter(const char* id, bool vertical, float length, float sign, float now, double& size) {
  const ImVec2 extent = vertical ? ImVec2(Px(kSplitter), length) : ImVec2(length, Px(kSplitter));
  ImGui::PushItemFlag(ImGuiItemFlags_NoNav, true);  // Keys cannot activate the splitter.
  ImGui::InvisibleButton(id, extent);
  ImGui::PopItemFlag();
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  }
  if (ImGui::IsItemActive()) {
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    const float moved = vertical ? delta.x : delta.y;
    if (moved != 0.0f) {
      size = std::max(now + sign * moved / Px(1.0f), 1.0f);
    }
  }
}

// Limits a size to the room in the window.
float Fitted(double size, float least, float most) {
  return std::clamp(static_cast<float>(size), least, std::max(least, most));
}

bool BeginPanel(const char* id, const ImVec2& size, ImGuiWindowFlags flags = 0) {
  ImGui::PushStyleColor(ImGuiCol_ChildBg, panels::Colours().panel);
  const bool open =
      ImGui::BeginChild(id, size, false, ImGuiWindowFlags_AlwaysUseWindowPadding | flags);
  ImGui::PopStyleColor();
  return open;
}

// The focus of a panel that takes over the keyboard.
Focus FocusOf(Region region, BottomTab tab) {
  if (region != Region::kBottom) {
    return Focus::kViews;
  }
  return tab == BottomTab::kTimeline ? Focus::kTimeline
         : tab == BottomTab::kScript ? Focus::kScript
                                     : Focus::kViews;
}

// Whether the panel's content handles keys itself.
bool HasOwnKeys(Region region, BottomTab tab) {
  return region == Region::kView ||
         (region == Region::kBottom && (tab == BottomTab::kTimeline || tab == BottomTab::kScript));
}

// Paints the current panel's background only around the picture that covers the rest of it. With a
// software renderer, hidden pixels cost as much as visible ones.
void PaintPanelAroundRest() {
  const ImVec2 panel = ImGui::GetWindowPos();
  const ImVec2 panel_end(panel.x + ImGui::GetWindowWidth(), panel.y + ImGui::GetWindowHeight());
  const ImVec2 rest = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  const ImVec2 rest_end(rest.x + std::floor(size.x), rest.y + std::floor(size.y));
  const ImU32 colour = ImGui::GetColorU32(panels::Colours().panel);
  const float rounding = ImGui::GetStyle().ChildRounding;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(panel, panel_end);
  draw.AddRectFilled(panel, ImVec2(panel_end.x, rest.y), colour, rounding,
                     ImDrawFlags_RoundCornersTop);
  draw.AddRectFilled(ImVec2(panel.x, rest_end.y), panel_end, colour, rounding,
                     ImDrawFlags_RoundCornersBottom);
  draw.AddRectFilled(ImVec2(panel.x, rest.y), ImVec2(rest.x, rest_end.y), colour);
  draw.AddRectFilled(ImVec2(rest_end.x, rest.y), ImVec2(panel_end.x, rest_end.y), colour);
  draw.PopClipRect();
}

}  // namespace

Result<std::unique_ptr<Layout>> Layout::Create() {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<panels::SceneView> around, panels::SceneView::Create());
  return std::unique_ptr<Layout>(new Layout(std::move(around)));
}

void Layout::BeginFilming(const std::string& place) {
  dialogs_.shown = panels::Dialog::kFilm;
  dialogs_.fields = {};
  dialogs_.fields.place = place;
}

void Layout::TellOfDrop(const std::string& text) {
  dialogs_.shown = panels::Dialog::kDropMessage;
  dialogs_.fields = {};
  dialogs_.fields.title = text;
}

void Layout::Drop(Workspace& workspace, const panels::DroppedFile& dropped) {
  using Kind = panels::DroppedFile::Kind;
  const PlaceDocument* place = workspace.project().place();
  panels::DialogFields fields;
  fields.file = dropped.file.string();
  fields.images = dropped.kind == Kind::kImages;
  switch (dropped.kind) {
    case Kind::kVideo:
    case Kind::kImages:
      fields.place = place != nullptr ? place->label() : "";
      dialogs_.shown = workspace.map().loaded().database != nullptr ? panels::Dialog::kAddSession
                                                                    : panels::Dialog::kTrain;
      break;
    case Kind::kModel:
      dialogs_.shown = panels::Dialog::kDroppedModel;
      break;
    case Kind::kFigure:
      fields.title = dropped.file.stem().string();
      dialogs_.shown = panels::Dialog::kCast;
      break;
    case Kind::kProbe:
      if (place == nullptr) {
        TellOfDrop(panels::Tr("A light probe belongs to a place: train one first."));
        return;
      }
      fields.name = PlainNameOf(dropped.file.stem().string());
      dialogs_.shown = panels::Dialog::kProbe;
      break;
    case Kind::kProject:
    case Kind::kOther:
      TellOfDrop(panels::UselessDropText(dropped.file.filename().string()));
      return;
  }
  dialogs_.fields = fields;
}

void Layout::DrawViewport(Workspace& workspace) {
  switch (options_.view) {
    case panels::ViewKind::kCamera:
      camera_.Show(Context(workspace));
      break;
    case panels::ViewKind::kAround:
      PaintPanelAroundRest();
      around_->Show(Context(workspace));
      break;
    case panels::ViewKind::kPicks:
      picks_.Show(Context(workspace));
      break;
  }
}

void Layout::DrawBottom(Workspace& workspace) {
  const int problems = panels::CountProblems(workspace) + missing_.count();
  const std::string checks =
      problems > 0 ? panels::Text(panels::Tr("Checks (%d)"), problems) : panels::Tr("Checks");
  const char* const labels[] = {panels::Tr("Timeline"), panels::Tr("Script"), checks.c_str(),
                                panels::Tr("Messages")};
  int tab = static_cast<int>(bottom_);
  if (panels::Segmented("tabs", labels, tab)) {
    bottom_ = static_cast<BottomTab>(tab);
  }
  if (bottom_ == BottomTab::kMessages) {
    messages_read_ = workspace.messages().told();
  } else {
    panels::MarkUnread(workspace, messages_read_);
  }
  ImGui::SameLine(0.0f, Px(20));
  switch (bottom_) {
    case BottomTab::kTimeline:
      timeline_.DrawTools(workspace, input_);
      timeline_.Show(workspace, input_, actions_);
      tools_.walks.item = timeline_.single_item();
      tools_.walks.task = timeline_.task();
      break;
    case BottomTab::kScript:
      script_.DrawTools(workspace);
      script_.Show(workspace, input_);
      break;
    case BottomTab::kChecks:
      panels::DrawChecksTools(workspace);
      missing_.Show(workspace);
      panels::DrawChecks(workspace, selection_, input_, actions_);
      break;
    case BottomTab::kMessages:
      ImGui::NewLine();
      ImGui::BeginChild("messages", ImVec2(0, 0), false, ImGuiWindowFlags_NavFlattened);
      panels::DrawMessages(workspace);
      ImGui::EndChild();
      break;
  }
}

void Layout::DrawPanels(Workspace& workspace, PanelSizes& sizes) {
  const float status = ImGui::GetFrameHeight() + Px(4);
  const ImVec2 available = ImGui::GetContentRegionAvail();
  const float widest = (available.x / Px(1.0f) - kMinViewportWidth) * 0.5f;
  const float outliner = Fitted(sizes.outliner, kMinPanel, widest);
  const float inspector = Fitted(sizes.inspector, kMinPanel, widest);
  const float tallest = available.y / Px(1.0f) - kMinViewportHeight;
  // Keep a reference now, because drawing may change the tab.
  double& bottom_size = sizes.bottom[static_cast<size_t>(bottom_)];
  const float bottom = Fitted(bottom_size, kMinBottom, tallest);
  ResizeByKeys(outliner, inspector, bottom, sizes);

  const float upper = available.y - Px(bottom) - status - 2 * Px(kSplitter);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  const ImVec2 spacing(Px(8), Px(7));  // Spacing within the panels.
  const auto panel = [&](Region region, const char* id, const ImVec2& size, auto&& show,
                         ImGuiWindowFlags flags = 0) {
    input_.keyboard.Before(region);
    BeginPanel(id, size, flags);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, spacing);
    input_.keyboard.Begin(region, HasOwnKeys(region, bottom_));
    if (input_.keyboard.TakesOver(region)) {
      input_.focus = FocusOf(region, bottom_);
    }
    show();
    input_.keyboard.End(region);
    ImGui::PopStyleVar();
    ImGui::EndChild();
  };
  panel(Region::kOutliner, "outliner", ImVec2(Px(outliner), upper),
        [&] { panels::DrawOutliner(workspace, selection_, tools_.check, pictures_, dialogs_); });
  ImGui::SameLine();
  Splitter("split outliner", true, upper, 1.0f, outliner, sizes.outliner);
  ImGui::SameLine();
  const float viewport = available.x - Px(outliner) - Px(inspector) - 2 * Px(kSplitter);
  const bool covered = options_.view == panels::ViewKind::kAround;
  panel(
      Region::kView, "viewport", ImVec2(viewport, upper), [&] { DrawViewport(workspace); },
      covered ? ImGuiWindowFlags_NoBackground : 0);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
      ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    input_.focus = panels::Focus::kViews;
  }
  ImGui::SameLine();
  Splitter("split inspector", true, upper, -1.0f, inspector, sizes.inspector);
  ImGui::SameLine();
  panel(Region::kInspector, "inspector", ImVec2(Px(inspector), upper),
        [&] { panels::DrawInspector(Context(workspace)); });
  Splitter("split bottom", false, available.x, -1.0f, bottom, bottom_size);
  panel(Region::kBottom, "bottom", ImVec2(available.x, Px(bottom)), [&] { DrawBottom(workspace); });
  ImGui::Dummy(ImVec2(0, Px(kSplitter)));
  ImGui::PopStyleVar();
  panels::DrawStatusBar(workspace);
}

void Layout::TakeResizing() {
  constexpr float kStep = 24.0f;
  std::erase_if(input_.keys, [&](const panels::KeyPress& press) {
    const panels::KeyAction action = panels::ActionOf(panels::KeyScope::kAlways, press);
    const bool larger = action == panels::KeyAction::kPanelLarger;
    const bool resizes = larger || action == panels::KeyAction::kPanelSmaller;
    grow_ += !resizes ? 0.0f : larger ? kStep : -kStep;
    return resizes;
  });
}

// outliner, inspector, bottom: their displayed sizes.
void Layout::ResizeByKeys(float outliner, float inspector, float bottom, PanelSizes& sizes) {
  const float grow = std::exchange(grow_, 0.0f);
  if (grow == 0.0f) {
    return;
  }
  double& bottom_size = sizes.bottom[static_cast<size_t>(bottom_)];
  switch (input_.keyboard.now()) {
    case Region::kOutliner:
      sizes.outliner = std::max(outliner + grow, kMinPanel);
      break;
    case Region::kInspector:
      sizes.inspector = std::max(inspector + grow, kMinPanel);
      break;
    case Region::kBottom:
    case Region::kItem:
      bottom_size = std::max(bottom + grow, kMinBottom);
      break;
    default:  // The view gets the space that the others leave.
      bottom_size = std::max(bottom - grow, kMinBottom);
      break;
  }
}

void Layout::HandleKeys(Workspace& workspace) {
  panels::KeyboardFocus& keyboard = input_.keyboard;
  keyboard.BeginFrame();
  const bool dialog = dialogs_.shown != panels::Dialog::kNone || calibration_.is_open();
  if (!dialog && (menus_ || panels::KeysBelongToMenus())) {
    input_.keys.clear();
  } else if (!dialog && keyboard.walks()) {
    const bool idle = !ImGui::GetIO().WantTextInput && !ImGui::IsAnyItemActive();
    std::erase_if(input_.keys, [&](const panels::KeyPress& press) {
      const panels::KeyAction action = panels::ActionOf(panels::KeyScope::kPanels, press);
      if (action == panels::KeyAction::kStopWalking && idle) {
        keyboard.Ask(Region::kView, false);
      }
      return action != panels::KeyAction::kNone && idle;
    });
  }
  if (!dialog) {
    TakeResizing();
  }
  if (bottom_ == BottomTab::kTimeline && dialogs_.shown == panels::Dialog::kNone) {
    timeline_.HandleKeys(workspace, input_, actions_);
  }
  panels::HandleShortcuts(Context(workspace));
}

void Layout::DrainActions(const Workspace& workspace) {
  for (const panels::EditorAction& action : std::exchange(actions_, {})) {
    if (std::holds_alternative<panels::CloseWindow>(action)) {
      quit_ = true;
    } else if (std::holds_alternative<panels::CloseProject>(action)) {
      leave_ = true;
    } else if (std::holds_alternative<panels::StopWorkAndLeave>(action)) {
      stops_work_ = true;
    } else if (std::holds_alternative<panels::StartTour>(action)) {
      tour_.Begin(panels::FactsOf(workspace, selection_, options_, dialogs_));
    } else if (const auto* tab = std::get_if<panels::OpenTab>(&action)) {
      bottom_ = tab->tab;
    } else if (const auto* script = std::get_if<panels::GoToScriptLine>(&action)) {
      bottom_ = BottomTab::kScript;
      script_.GoToLine(script->line);
    } else if (const auto* chosen = std::get_if<panels::SelectTimelineItem>(&action)) {
      timeline_.Select(chosen->item);
    } else if (std::holds_alternative<panels::OpenOnionSettings>(action)) {
      camera_.OpenOnionSettings();
    }
  }
}

// Closing the question cancels the request.
void Layout::AskBeforeLeaving(const Workspace& workspace) {
  may_leave_ = !workspace.AtLongWork() || stops_work_;
  if (!(quit_ || leave_) || may_leave_) {
    return;
  }
  if (std::exchange(asked_, true)) {
    if (dialogs_.shown != panels::Dialog::kLeave) {
      quit_ = leave_ = asked_ = false;
    }
    return;
  }
  if (dialogs_.shown != panels::Dialog::kNone) {
    dialogs_.left[dialogs_.shown] = dialogs_.fields;
  }
  dialogs_.shown = panels::Dialog::kLeave;
}

void Layout::Show(Workspace& workspace, Settings& settings, PanelSizes& sizes) {
  missing_.Look(workspace);
  if (!std::exchange(opened_, true) && missing_.count() > 0) {
    bottom_ = panels::BottomTab::kChecks;  // Missing files can be located there.
  }
  if (missing_.locating()) {
    input_.keys.clear();
  }
  HandleKeys(workspace);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  input_.keyboard.Before(Region::kToolbar);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(Px(8), Px(6)));
  // The window already has its background's colour.
  ImGui::Begin("Lararium", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_MenuBar |
                   ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  input_.keyboard.Begin(Region::kToolbar);
  panels::DrawMenuBar(Context(workspace), bottom_, settings);
  panels::DrawToolbar(workspace, options_, tools_.gizmo, dialogs_);
  DrainActions(workspace);
  input_.dialog_open = dialogs_.shown != panels::Dialog::kNone;
  DrawPanels(workspace, sizes);
  if (calibration_.is_open()) {
    calibration_.Show(workspace.project().paths(), pictures_, dialogs_.fields);
  } else if (panels::DrawDialogs(Context(workspace))) {
    calibration_.Open();
  }
  film_.Show(workspace, pictures_, dialogs_);
  live_camera_.Show(workspace, options_, dialogs_);
  AskBeforeLeaving(workspace);
  input_.keyboard.End(Region::kToolbar);
  ImGui::End();
  panels::DrawTourCard(workspace, selection_, options_, dialogs_, input_, tour_);
  input_.keys.clear();
  menus_ = panels::KeysBelongToMenus();
}

}  // namespace lararium::editor
