#pragma once

// Which part of the window has the keyboard, for use without a mouse. Ctrl+Tab moves to the next
// region and shows a ring around it; there the arrow keys move the focus, and Enter or Space
// activate (ImGui's navigation). The views, the timeline and the script have their own keys
// instead. A click hides the ring.

#include <optional>

namespace lararium::panels {

enum class Region { kToolbar, kOutliner, kView, kInspector, kBottom, kItem, kTour };

class KeyboardFocus {
 public:
  // Requests the next or the previous visible region, in the order of Region.
  void Step(bool back);
  // Requests a region, with or without a ring.
  void Ask(Region region, bool ring);
  // Requests the menu bar. Call within its window.
  void AskForMenus() { menus_asked_ = true; }

  // Call around the content of a region: Before() before ImGui's Begin() or BeginChild(), the
  // others as first and last call inside.
  void Before(Region region);
  void Begin(Region region, bool has_own_keys = false);
  void End(Region region);

  // Call once per frame, before any region.
  void BeginFrame();

  // The region of the frame before.
  Region now() const { return now_; }
  // Whether the region was requested in this frame and has the keyboard from now on.
  bool TakesOver(Region region) const { return taken_ == region; }
  // Whether arrows, Enter and Space belong to the region's buttons and fields.
  bool walks() const { return ring_ && !own_keys_; }

 private:
  bool was_shown(int region) const { return (shown_before_ >> region & 1) != 0; }

  Region now_ = Region::kView;
  bool ring_ = false;
  bool own_keys_ = true;                         // The region now_ has its own keys.
  std::optional<Region> asked_ = Region::kView;  // Requested for the next frame.
  std::optional<Region> taken_;
  bool menus_asked_ = false;
  bool told_ = false;          // The region, or one within it, was processed in this frame.
  unsigned shown_ = 0;         // Bits of the regions in this frame.
  unsigned shown_before_ = 0;  // Bits of the regions in the frame before.
};

// Whether a menu, a list or a dialog is open, or the menu bar has the keyboard.
bool KeysBelongToMenus();

// Controls ImGui's navigation, which is on while the keyboard moves the focus and in menus and
// dialogs.
class Navigation {
 public:
  // Call before each of ImGui's frames.
  void Prepare(bool walk);

 private:
  bool menus_ = false;      // Menus had the keyboard before the last frame.
  bool keys_last_ = false;  // The last input was a key, not the mouse.
};

}  // namespace lararium::panels
