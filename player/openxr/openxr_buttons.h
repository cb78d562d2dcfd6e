#pragma once

// The buttons of a headset's controllers as OpenXR actions: one that selects and one for menus
// (visitor_actions.h), for all kinds of controllers. Private to the OpenXR headset.

#include <array>
#include <string>
#include <vector>

#include "player/kiosk/visitor_actions.h"
#include "player/openxr/openxr_calls.h"

namespace lararium::player {

class OpenXrButtons {
 public:
  OpenXrButtons() = default;
  OpenXrButtons(const OpenXrButtons&) = delete;
  OpenXrButtons& operator=(const OpenXrButtons&) = delete;

  // Call this once, before the session begins.
  Status Begin(XrInstance instance, XrSession session);

  // Appends the names of buttons that were pressed by either hand since the last call. The session
  // must be running. Appends nothing while another program uses the controllers.
  Status Take(std::vector<std::string>& pressed);

 private:
  struct Button {
    const char* name;
    XrAction action = XR_NULL_HANDLE;
    bool held = false;
  };

  Status CreateActions();
  Status SuggestBindings() const;
  // Returns XR_NULL_PATH if the runtime does not know the path.
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
