#pragma once

// The buttons of a headset's controllers, by OpenXR's actions: one that selects and one for menus
// (visitor_actions.h), whatever kind of controller it is. Private to the OpenXR headset.

#include <array>
#include <string>
#include <vector>

#include "player/openxr_calls.h"
#include "player/visitor_actions.h"

namespace lararium::player {

class OpenXrButtons {
 public:
  OpenXrButtons() = default;
  OpenXrButtons(const OpenXrButtons&) = delete;
  OpenXrButtons& operator=(const OpenXrButtons&) = delete;

  // Once, for a session that has not begun.
  Status Begin(XrInstance instance, XrSession session);

  // Adds the names of those that were pressed since the last time, by either hand. In a session
  // that runs; nothing while another program has the controllers.
  Status Take(std::vector<std::string>& pressed);

 private:
  struct Button {
    const char* name;
    XrAction action = XR_NULL_HANDLE;
    bool held = false;
  };

  Status CreateActions();
  Status SuggestBindings() const;
  // XR_NULL_PATH where the runtime does not know it.
  XrPath PathOf(const std::string& text) const;
  Status Check(XrResult result, const char* what) const {
    return ToStatus(instance_, result, what);
  }

  XrInstance instance_ = XR_NULL_HANDLE;
  XrSession session_ = XR_NULL_HANDLE;
  XrActionSet set_ = XR_NULL_HANDLE;
  std::array<Button, 2> buttons_ = {{{kHandSelect}, {kHandMenu}}};
};

}  // namespace lararium::player
