#include "editor/panels/widgets/key_state.h"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <span>

namespace lararium::panels {

#if IMGUI_VERSION_NUM < 18700

bool AnyKeyIsDown() {
  const std::span<const bool> keys = ImGui::GetIO().KeysDown;
  return std::find(keys.begin(), keys.end(), true) != keys.end();
}

bool EnterIsPressed() {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) ||
         ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_KeyPadEnter), false);
}

void PrepareKeys() {
  ImGuiIO& io = ImGui::GetIO();
  if (io.KeysDown[GLFW_KEY_ENTER] || io.KeysDown[GLFW_KEY_KP_ENTER]) {
    io.NavInputs[ImGuiNavInput_Activate] = 1.0f;
  }
  io.KeyMap[ImGuiKey_Tab] = io.KeyCtrl ? -1 : GLFW_KEY_TAB;
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

#else

bool AnyKeyIsDown() {
  for (int key = ImGuiKey_Keyboard_BEGIN; key < ImGuiKey_Keyboard_END; ++key) {
    if (ImGui::IsKeyDown(static_cast<ImGuiKey>(key))) {
      return true;
    }
  }
  return false;
}

bool EnterIsPressed() {
  return ImGui::IsKeyPressed(ImGuiKey_Enter, false) ||
         ImGui::IsKeyPressed(ImGuiKey_KeypadEnter, false);
}

void PrepareKeys() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  g.ConfigNavWindowingKeyNext = 0;
  g.ConfigNavWindowingKeyPrev = 0;
}

// The queue of events keeps a key down for a frame by itself.
void KeyLatch::Press(int, int) {}
void KeyLatch::Hold() {}
void KeyLatch::LetGo() {}

#endif

}  // namespace lararium::panels
