#include "editor/window/layout.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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
  state_.dialog = panels::Dialog::kFilm;
  state_.fields = {};
  state_.fields.place = place;
}

void Layout::DrawViewport(Workspace& workspace) {
  switch (state_.view) {
    case panels::ViewKind::kCamera:
      camera_.Show(workspace, state_);
      break;
    case panels::ViewKind::kAround:
      PaintPanelAroundRest();
      around_->Show(workspace, state_);
      break;
    case panels::ViewKind::kPicks:
      picks_.Show(workspace, state_);
      break;
  }
}

void Layout::DrawBottom(Workspace& workspace) {
  const int problems = panels::CountProblems(workspace) + missing_.count();
  const std::string checks =
      problems > 0 ? panels::Text(panels::Tr("Checks (%d)"), problems) : panels::Tr("Checks");
  const char* const labels[] = {panels::Tr("Timeline"), panels::Tr("Script"), checks.c_str(),
                                panels::Tr("Messages")};
  int tab = static_cast<int>(state_.bottom);
  if (panels::Segmented("tabs", labels, tab)) {
    state_.bottom = static_cast<BottomTab>(tab);
  }
  if (state_.bottom == BottomTab::kMessages) {
    state_.messages_read = workspace.messages().told();
  } else {
    panels::MarkUnread(workspace, state_.messages_read);
  }
  ImGui::SameLine(0.0f, Px(20));
  switch (state_.bottom) {
    case BottomTab::kTimeline:
      timeline_.DrawTools(workspace, state_);
      timeline_.Show(workspace, state_);
      break;
    case BottomTab::kScript:
      script_.DrawTools(workspace, state_);
      script_.Show(workspace, state_);
      break;
    case BottomTab::kChecks:
      panels::DrawChecksTools(workspace);
      missing_.Show(workspace);
      panels::DrawChecks(workspace, state_);
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
  double& bottom_size = sizes.bottom[static_cast<size_t>(state_.bottom)];
  const float bottom = Fitted(bottom_size, kMinBottom, tallest);
  ResizeByKeys(outliner, inspector, bottom, sizes);

  const float upper = available.y - Px(bottom) - status - 2 * Px(kSplitter);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  const ImVec2 spacing(Px(8), Px(7));  // Spacing within the panels.
  const auto panel = [&](Region region, const char* id, const ImVec2& size, auto&& show,
                         ImGuiWindowFlags flags = 0) {
    state_.keyboard.Before(region);
    BeginPanel(id, size, flags);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, spacing);
    state_.keyboard.Begin(region, HasOwnKeys(region, state_.bottom));
    if (state_.keyboard.TakesOver(region)) {
      state_.focus = FocusOf(region, state_.bottom);
    }
    show();
    state_.keyboard.End(region);
    ImGui::PopStyleVar();
    ImGui::EndChild();
  };
  panel(Region::kOutliner, "outliner", ImVec2(Px(outliner), upper),
        [&] { panels::DrawOutliner(workspace, state_); });
  ImGui::SameLine();
  Splitter("split outliner", true, upper, 1.0f, outliner, sizes.outliner);
  ImGui::SameLine();
  const float viewport = available.x - Px(outliner) - Px(inspector) - 2 * Px(kSplitter);
  const bool covered = state_.view == panels::ViewKind::kAround;
  panel(
      Region::kView, "viewport", ImVec2(viewport, upper), [&] { DrawViewport(workspace); },
      covered ? ImGuiWindowFlags_NoBackground : 0);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
      ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    state_.focus = panels::Focus::kViews;
  }
  ImGui::SameLine();
  Splitter("split inspector", true, upper, -1.0f, inspector, sizes.inspector);
  ImGui::SameLine();
  panel(Region::kInspector, "inspector", ImVec2(Px(inspector), upper),
        [&] { panels::DrawInspector(workspace, state_); });
  Splitter("split bottom", false, available.x, -1.0f, bottom, bottom_size);
  panel(Region::kBottom, "bottom", ImVec2(available.x, Px(bottom)), [&] { DrawBottom(workspace); });
  ImGui::Dummy(ImVec2(0, Px(kSplitter)));
  ImGui::PopStyleVar();
  panels::DrawStatusBar(workspace);
}

void Layout::TakeResizing() {
  constexpr float kStep = 24.0f;
  std::erase_if(state_.keys, [&](const panels::KeyPress& press) {
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
  double& bottom_size = sizes.bottom[static_cast<size_t>(state_.bottom)];
  switch (state_.keyboard.now()) {
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
  panels::KeyboardFocus& keyboard = state_.keyboard;
  keyboard.BeginFrame();
  const bool dialog = state_.dialog != panels::Dialog::kNone || calibration_.is_open();
  if (!dialog && (menus_ || panels::KeysBelongToMenus())) {
    state_.keys.clear();
  } else if (!dialog && keyboard.walks()) {
    const bool idle = !ImGui::GetIO().WantTextInput && !ImGui::IsAnyItemActive();
    std::erase_if(state_.keys, [&](const panels::KeyPress& press) {
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
  timeline_.HandleKeys(workspace, state_);
  panels::HandleShortcuts(workspace, state_);
}

// Closing the question cancels the request.
void Layout::AskBeforeLeaving(const Workspace& workspace) {
  may_leave_ = !workspace.AtLongWork() || state_.stops_work;
  if (!(state_.quit || state_.leave) || may_leave_) {
    return;
  }
  if (std::exchange(asked_, true)) {
    if (state_.dialog != panels::Dialog::kLeave) {
      state_.quit = state_.leave = asked_ = false;
    }
    return;
  }
  if (state_.dialog != panels::Dialog::kNone) {
    state_.left[state_.dialog] = state_.fields;
  }
  state_.dialog = panels::Dialog::kLeave;
}

void Layout::Show(Workspace& workspace, Settings& settings, PanelSizes& sizes) {
  state_.settings = settings;
  missing_.Look(workspace);
  if (!std::exchange(opened_, true) && missing_.count() > 0) {
    state_.bottom = panels::BottomTab::kChecks;  // Missing files can be located there.
  }
  if (missing_.locating()) {
    state_.keys.clear();
  }
  HandleKeys(workspace);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  state_.keyboard.Before(Region::kToolbar);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(Px(8), Px(6)));
  // The window already has its background's colour.
  ImGui::Begin("Lararium", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_MenuBar |
                   ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  state_.keyboard.Begin(Region::kToolbar);
  panels::DrawMenuBar(workspace, state_);
  panels::DrawToolbar(workspace, state_);
  DrawPanels(workspace, sizes);
  if (calibration_.is_open()) {
    calibration_.Show(workspace.project().paths(), state_.pictures, state_.fields);
  } else if (panels::DrawDialogs(workspace, state_)) {
    calibration_.Open();
  }
  film_.Show(workspace, state_);
  live_camera_.Show(workspace, state_);
  AskBeforeLeaving(workspace);
  if (std::exchange(state_.begin_tour, false)) {
    tour_.Begin(panels::FactsOf(workspace, state_));
  }
  state_.keyboard.End(Region::kToolbar);
  ImGui::End();
  panels::DrawTourCard(workspace, state_, tour_);
  state_.keys.clear();
  menus_ = panels::KeysBelongToMenus();
  settings = state_.settings;
}

}  // namespace lararium::editor
