#include "player/openxr/openxr_buttons.h"

#include <cstdio>

namespace lararium::player {
namespace {

// The inputs of a kind of controller for each of our buttons (OpenXR 1.0, section 6.4).
struct Controller {
  const char* profile;                               // path below /interaction_profiles/
  std::array<std::array<const char*, 2>, 2> inputs;  // [button][left, right]; nullptr: none
};
constexpr Controller kControllers[] = {
    {"khr/simple_controller", {{{"select/click", "select/click"}, {"menu/click", "menu/click"}}}},
    {"oculus/touch_controller", {{{"trigger/value", "trigger/value"}, {"menu/click", "b/click"}}}},
    {"valve/index_controller", {{{"trigger/click", "trigger/click"}, {"b/click", "b/click"}}}},
    {"htc/vive_controller", {{{"trigger/click", "trigger/click"}, {"menu/click", "menu/click"}}}},
    {"microsoft/motion_controller",
     {{{"trigger/value", "trigger/value"}, {"menu/click", "menu/click"}}}},
    {"google/daydream_controller", {{{"select/click", "select/click"}, {nullptr, nullptr}}}},
};
constexpr std::array<const char*, 2> kHands = {"/user/hand/left/input/", "/user/hand/right/input/"};

}  // namespace

Status OpenXrButtons::Begin(XrInstance instance, XrSession session) {
  instance_ = instance;
  session_ = session;
  LARARIUM_RETURN_IF_ERROR(CreateActions());
  LARARIUM_RETURN_IF_ERROR(SuggestBindings());
  auto attach = Typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
  attach.countActionSets = 1;
  attach.actionSets = &set_;
  return Check(xrAttachSessionActionSets(session_, &attach), "taking the controllers' buttons");
}

Status OpenXrButtons::CreateActions() {
  auto create = Typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
  std::snprintf(create.actionSetName, sizeof(create.actionSetName), "visitor");
  std::snprintf(create.localizedActionSetName, sizeof(create.localizedActionSetName), "Visitor");
  LARARIUM_RETURN_IF_ERROR(Check(xrCreateActionSet(instance_, &create, &set_), "actions"));
  for (Button& button : buttons_) {
    auto action = Typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    std::snprintf(action.actionName, sizeof(action.actionName), "%s", button.name);
    std::snprintf(action.localizedActionName, sizeof(action.localizedActionName), "%s",
                  button.name);
    action.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
    LARARIUM_RETURN_IF_ERROR(Check(xrCreateAction(set_, &action, &button.action), "an action"));
  }
  return Status();
}

XrPath OpenXrButtons::PathOf(const std::string& text) const {
  XrPath path = XR_NULL_PATH;
  return XR_SUCCEEDED(xrStringToPath(instance_, text.c_str(), &path)) ? path : XR_NULL_PATH;
}

// Kinds of controllers that the runtime does not know are skipped. If it knows none of them, the
// headset has no buttons.
Status OpenXrButtons::SuggestBindings() const {
  for (const Controller& controller : kControllers) {
    std::vector<XrActionSuggestedBinding> bindings;
    for (size_t button = 0; button < buttons_.size(); ++button) {
      for (size_t hand = 0; hand < kHands.size(); ++hand) {
        if (const char* input = controller.inputs[button][hand]; input != nullptr) {
          bindings.push_back({buttons_[button].action, PathOf(std::string(kHands[hand]) + input)});
        }
      }
    }
    auto suggest =
        Typed<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    suggest.interactionProfile = PathOf(std::string("/interaction_profiles/") + controller.profile);
    suggest.countSuggestedBindings = static_cast<uint32_t>(bindings.size());
    suggest.suggestedBindings = bindings.data();
    const XrResult result = xrSuggestInteractionProfileBindings(instance_, &suggest);
    if (result != XR_ERROR_PATH_UNSUPPORTED) {
      LARARIUM_RETURN_IF_ERROR(Check(result, "naming the controllers' buttons"));
    }
  }
  return Status();
}

Status OpenXrButtons::Take(std::vector<std::string>& pressed) {
  const XrActiveActionSet active = {set_, XR_NULL_PATH};
  auto sync = Typed<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
  sync.countActiveActionSets = 1;
  sync.activeActionSets = &active;
  // Without the focus, all actions are inactive.
  LARARIUM_RETURN_IF_ERROR(Check(xrSyncActions(session_, &sync), "asking for the buttons"));
  for (Button& button : buttons_) {
    auto get = Typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    get.action = button.action;
    auto state = Typed<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
    LARARIUM_RETURN_IF_ERROR(
        Check(xrGetActionStateBoolean(session_, &get, &state), "asking for a button"));
    const bool held = state.isActive == XR_TRUE && state.currentState == XR_TRUE;
    if (held && !button.held) {
      pressed.emplace_back(button.name);
    }
    button.held = held;
  }
  return Status();
}

}  // namespace lararium::player
