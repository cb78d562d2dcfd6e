#pragma once

// ImGui's state of the keyboard, which differs between its versions: up to 1.86 (Debian 12) it
// samples arrays that the application may change; later ones (Debian 13) queue events.

#include <vector>

namespace lararium::panels {

bool AnyKeyIsDown();
// Whether Enter was pressed in this frame, on the keyboard or on its number pad.
bool EnterIsPressed();

// Call before each frame. Makes Enter activate where ImGui would accept only Space, and keeps
// Ctrl+Tab, which switches regions, from switching ImGui's windows.
void PrepareKeys();

// Holds keys down for a frame that are pressed and released between two frames, where ImGui would
// miss them.
class KeyLatch {
 public:
  // key, modifiers: GLFW's codes.
  void Press(int key, int modifiers);
  // Call around each frame.
  void Hold();
  void LetGo();

 private:
  struct Pressed {
    int key = 0;
    int modifiers = 0;
  };
  std::vector<Pressed> pressed_;  // Pressed since the last frame.
  std::vector<int> held_;         // Held in this frame.
};

}  // namespace lararium::panels
