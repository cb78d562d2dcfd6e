#include "editor/panels/widgets/keyboard_focus.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <span>

#include "editor/panels/widgets/key_state.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

namespace {

constexpr int kRegions = static_cast<int>(Region::kTour) + 1;
constexpr float kRing = 2.0f;  // logical pixels

bool AnyPopup() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool MouseIsUsed() {
  const ImGuiIO& io = ImGui::GetIO();
  const auto any = [](std::span<const bool> buttons) {
    return std::find(buttons.begin(), buttons.end(), true) != buttons.end();
  };
  return any(io.MouseDown) || any(io.MouseClicked) || any(io.MouseReleased);
}

// Shows the keyboard focus from now on; the mouse hovers nothing until it moves.
void DrawNavigation() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  g.NavDisableHighlight = false;
  g.NavDisableMouseHover = true;
}

}  // namespace

void KeyboardFocus::Step(bool back) {
  int next = static_cast<int>(now_);
  do {
    next = (next + (back ? kRegions - 1 : 1)) % kRegions;
  } while (!was_shown(next) && next != static_cast<int>(now_));
  Ask(static_cast<Region>(next), true);
}

void KeyboardFocus::Ask(Region region, bool ring) {
  ImGui::ClearActiveID();  // The active field has already received its text.
  asked_ = region;
  ring_ = ring;
}

void KeyboardFocus::BeginFrame() {
  taken_.reset();
  told_ = false;
  shown_before_ = shown_;
  shown_ = 0;
  const ImGuiIO& io = ImGui::GetIO();
  ring_ &= !io.MouseClicked[0] && !io.MouseClicked[1] && !io.MouseClicked[2];
}

void KeyboardFocus::Before(Region region) {
  if (asked_ == region) {
    ImGui::SetNextWindowFocus();
  }
}

void KeyboardFocus::Begin(Region region, bool has_own_keys) {
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  shown_ |= 1u << static_cast<int>(region);
  if (asked_ == region) {
    asked_.reset();
    taken_ = region;
    now_ = region;
    if (ring_ && !has_own_keys) {
      ImGui::NavInitWindow(window, false);
      DrawNavigation();
    }
  }
  if (region == Region::kToolbar && menus_asked_) {
    menus_asked_ = false;
    ImGui::ClearActiveID();
    ImGui::FocusWindow(window);
    ImGui::GetCurrentContext()->NavLayer = ImGuiNavLayer_Menu;
    ImGui::NavInitWindow(window, true);
    DrawNavigation();
  }
  if (now_ == region) {
    own_keys_ = has_own_keys;
  }
}

void KeyboardFocus::End(Region region) {
  // The toolbar is in the window that contains all others.
  const ImGuiFocusedFlags within =
      region == Region::kToolbar ? ImGuiFocusedFlags_None : ImGuiFocusedFlags_ChildWindows;
  if (!told_ && !asked_ && ImGui::IsWindowFocused(within)) {
    now_ = region;
    told_ = true;
  }
  if (ring_ && now_ == region && region != Region::kToolbar) {
    const ImVec2 from = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.PushClipRect(from, ImVec2(from.x + size.x, from.y + size.y));
    draw.AddRect(ImVec2(from.x + Px(1), from.y + Px(1)),
                 ImVec2(from.x + size.x - Px(1), from.y + size.y - Px(1)), Packed(Colours().accent),
                 ImGui::GetStyle().ChildRounding, 0, Px(kRing));
    draw.PopClipRect();
  }
}

bool KeysBelongToMenus() {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  // After a click that closes a menu, ImGui keeps the menu layer active but shows no focus.
  return AnyPopup() || (g.NavLayer == ImGuiNavLayer_Menu && !g.NavDisableHighlight);
}

void Navigation::Prepare(bool walk) {
  ImGuiIO& io = ImGui::GetIO();
  keys_last_ = !MouseIsUsed() && (keys_last_ || AnyKeyIsDown());
  const bool menus = KeysBelongToMenus();
  if (menus && !menus_ && keys_last_) {
    DrawNavigation();
  }
  menus_ = menus;
  if (walk || menus) {
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  } else {
    io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  }
  PrepareKeys();
  // AltTap handles Alt.
  ImGui::GetCurrentContext()->NavWindowingToggleLayer = false;
}

}  // namespace lararium::panels
