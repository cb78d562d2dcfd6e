#pragma once

// Which part of the window has the keyboard, for people who use no mouse: Ctrl+Tab gives it to the
// next one, which has a ring then; there the arrows walk, and Enter or Space press (ImGui's
// navigation). The views, the timeline and the script have keys of their own instead. A click takes
// the ring away.

#include <optional>
#include <vector>

namespace lararium::panels {

enum class Region { kToolbar, kOutliner, kView, kInspector, kBottom, kItem, kTour };

class KeyboardFocus {
 public:
  // Asks for the next region that was shown, or the one before, in the order above.
  void Step(bool back);
  // Asks for one; with a ring or without.
  void Ask(Region region, bool ring);
  // Asks for the menu bar, within the window that has it.
  void AskForMenus() { menus_asked_ = true; }

  // Around what a region shows: before ImGui's Begin() or BeginChild(), then first and last within.
  void Before(Region region);
  void Begin(Region region, bool has_own_keys = false);
  void End(Region region);

  // Once a frame, before any region.
  void BeginFrame();

  // Of the frame before.
  Region now() const { return now_; }
  // Whether it was asked for in this frame, and has it from now on.
  bool TakesOver(Region region) const { return taken_ == region; }
  // Whether arrows, Enter and Space belong to the region's buttons and fields.
  bool walks() const { return ring_ && !own_keys_; }

 private:
  bool was_shown(int region) const { return (shown_before_ >> region & 1) != 0; }

  Region now_ = Region::kView;
  bool ring_ = false;
  bool own_keys_ = true;                         // of now_
  std::optional<Region> asked_ = Region::kView;  // shown next
  std::optional<Region> taken_;
  bool menus_asked_ = false;
  bool told_ = false;          // in this frame, by the region or one within it
  unsigned shown_ = 0;         // bits of regions in this frame
  unsigned shown_before_ = 0;  // in the frame before
};

// Whether a menu, a list or a dialog is open, or the menu bar has the keyboard.
bool KeysBelongToMenus();

// ImGui's navigation, which is on where the keyboard walks, and in menus and dialogs.
class Navigation {
 public:
  // Before each of ImGui's frames. Where Space alone would press, Enter does too.
  void Prepare(bool walk);

 private:
  bool menus_ = false;      // had the keyboard before the last frame
  bool keys_last_ = false;  // a key was used since the mouse was
};

// ImGui 1.86 looks at the state of keys once a frame and misses what is pressed and released in
// between: this holds such keys down for one frame.
class KeyLatch {
 public:
  // key, modifiers: GLFW's.
  void Press(int key, int modifiers);
  // Around all of a frame.
  void Hold();
  void LetGo();

 private:
  struct Pressed {
    int key = 0;
    int modifiers = 0;
  };
  std::vector<Pressed> pressed_;  // since the last frame
  std::vector<int> held_;         // in this one
};

}  // namespace lararium::panels
