#include "editor/panels/widgets/keyboard_focus.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <span>

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

bool KeyIsUsed() {
  const std::span<const bool> keys = ImGui::GetIO().KeysDown;
  return std::find(keys.begin(), keys.end(), true) != keys.end();
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
  keys_last_ = !MouseIsUsed() && (keys_last_ || KeyIsUsed());
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
  if (io.KeysDown[GLFW_KEY_ENTER] || io.KeysDown[GLFW_KEY_KP_ENTER]) {
    io.NavInputs[ImGuiNavInput_Activate] = 1.0f;
  }
  // Ctrl+Tab switches regions instead of ImGui's windows, and AltTap handles Alt.
  io.KeyMap[ImGuiKey_Tab] = io.KeyCtrl ? -1 : GLFW_KEY_TAB;
  ImGui::GetCurrentContext()->NavWindowingToggleLayer = false;
}

void KeyLatch::Press(int key, int modifiers) { pressed_.push_back({key, modifiers}); }

void KeyLatch::Hold() {
  ImGuiIO& io = ImGui::GetIO();
  for (const Pressed& pressed : pressed_) {
    if (pressed.key < 0 || pressed.key >= IM_ARRAYSIZE(io.KeysDown) || io.KeysDown[pressed.key]) {
      continue;  // The key has no code or is still down.
    }
    io.KeysDown[pressed.key] = true;
    held_.push_back(pressed.key);
    io.KeyCtrl |= (pressed.modifiers & GLFW_MOD_CONTROL) != 0;
    io.KeyShift |= (pressed.modifiers & GLFW_MOD_SHIFT) != 0;
  }
  pressed_.clear();
}

void KeyLatch::LetGo() {
  ImGuiIO& io = ImGui::GetIO();
  if (held_.empty()) {
    return;
  }
  for (const int key : held_) {
    io.KeysDown[key] = false;
  }
  held_.clear();
  io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
  io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
}

}  // namespace lararium::panels
