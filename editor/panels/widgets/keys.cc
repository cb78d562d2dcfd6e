#include "editor/panels/widgets/keys.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

#include "editor/panels/widgets/text.h"

namespace lararium::panels {

namespace {

using Action = KeyAction;
using Scope = KeyScope;

constexpr int kCtrl = GLFW_MOD_CONTROL;
constexpr int kShift = GLFW_MOD_SHIFT;
constexpr int kAlt = GLFW_MOD_ALT;
constexpr int kKnownModifiers = kCtrl | kShift | kAlt;  // Lock keys such as Caps Lock are ignored.

constexpr auto kBindings = std::to_array<KeyBinding>({
    {Scope::kStart, Action::kNewProject, GLFW_KEY_N, kCtrl, 0,
     TrLater("Begins a new project from a video")},
    {Scope::kStart, Action::kNewFromImages, GLFW_KEY_I, kCtrl, 0,
     TrLater("Begins one from a folder of images")},
    {Scope::kStart, Action::kNewFromCamera, GLFW_KEY_K, kCtrl, 0,
     TrLater("Begins one by filming with a camera")},
    {Scope::kStart, Action::kNewEmpty, GLFW_KEY_N, kCtrl | kShift, 0,
     TrLater("Begins one without a place")},
    {Scope::kStart, Action::kOpenProject, GLFW_KEY_O, kCtrl, 0, TrLater("Opens a project")},

    {Scope::kAlways, Action::kKeyList, GLFW_KEY_F1, 0, 0, TrLater("Shows this list")},
    {Scope::kAlways, Action::kKeyList, 0, 0, U'?', nullptr},
    {Scope::kAlways, Action::kSave, GLFW_KEY_S, kCtrl, 0, TrLater("Saves")},
    {Scope::kAlways, Action::kUndo, GLFW_KEY_Z, kCtrl, 0, TrLater("Undoes")},
    {Scope::kAlways, Action::kRedo, GLFW_KEY_Z, kCtrl | kShift, 0, TrLater("Redoes")},
    {Scope::kAlways, Action::kRedo, GLFW_KEY_Y, kCtrl, 0, nullptr},
    {Scope::kAlways, Action::kLeave, GLFW_KEY_O, kCtrl, 0, TrLater("Goes to the start page")},
    {Scope::kAlways, Action::kQuit, GLFW_KEY_Q, kCtrl, 0, TrLater("Quits")},
    {Scope::kAlways, Action::kEvidence, GLFW_KEY_F2, 0, 0,
     TrLater("Colours by how certain things are")},
    {Scope::kAlways, Action::kTimelineTab, GLFW_KEY_F5, 0, 0, TrLater("Shows the timeline")},
    {Scope::kAlways, Action::kScriptTab, GLFW_KEY_F6, 0, 0, TrLater("Shows the script")},
    {Scope::kAlways, Action::kChecksTab, GLFW_KEY_F7, 0, 0, TrLater("Shows the checks")},
    {Scope::kAlways, Action::kMessagesTab, GLFW_KEY_F8, 0, 0, TrLater("Shows the messages")},
    {Scope::kAlways, Action::kPlay, GLFW_KEY_SPACE, 0, 0, TrLater("Plays and pauses")},
    {Scope::kAlways, Action::kPanelAfter, GLFW_KEY_TAB, kCtrl, 0,
     TrLater("Gives the keyboard to the next panel")},
    {Scope::kAlways, Action::kPanelBefore, GLFW_KEY_TAB, kCtrl | kShift, 0,
     TrLater("To the panel before")},
    {Scope::kAlways, Action::kMenus, GLFW_KEY_F10, 0, 0,
     TrLater("Gives it to the menus, as does a tap of Alt")},
    {Scope::kAlways, Action::kPanelSmaller, GLFW_KEY_F3, 0, 0,
     TrLater("The panel that has the keyboard becomes smaller")},
    {Scope::kAlways, Action::kPanelLarger, GLFW_KEY_F4, 0, 0, TrLater("Larger")},

    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_LEFT, 0, 0,
     TrLater("Walks; changes the number that was pressed; turns a portrait, which Home shows from "
             "the front")},
    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_RIGHT, 0, 0, nullptr},
    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_UP, 0, 0, nullptr},
    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_DOWN, 0, 0, nullptr},
    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_HOME, 0, 0, nullptr},
    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_END, 0, 0, nullptr},
    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_PAGE_UP, 0, 0, nullptr},
    {Scope::kPanels, Action::kWalkOn, GLFW_KEY_PAGE_DOWN, 0, 0, nullptr},
    {Scope::kPanels, Action::kPress, GLFW_KEY_ENTER, 0, 0,
     TrLater("Presses or opens what has the ring; confirms a dialog")},
    {Scope::kPanels, Action::kPress, GLFW_KEY_SPACE, 0, 0, nullptr},
    {Scope::kPanels, Action::kFieldAfter, GLFW_KEY_TAB, 0, 0,
     TrLater("To the next field that is typed into"), TrLater("the one before")},
    {Scope::kPanels, Action::kStopWalking, GLFW_KEY_ESCAPE, 0, 0,
     TrLater("Closes a menu, cancels a dialog; back to the views")},

    {Scope::kViews, Action::kCameraView, GLFW_KEY_1, 0, 0, TrLater("Looks through the camera")},
    {Scope::kViews, Action::kAroundView, GLFW_KEY_2, 0, 0, TrLater("Looks around the place")},
    {Scope::kViews, Action::kPickView, GLFW_KEY_3, 0, 0, TrLater("Shows the picks")},
    {Scope::kViews, Action::kMove, GLFW_KEY_W, 0, 0, TrLater("Handles move")},
    {Scope::kViews, Action::kTurn, GLFW_KEY_E, 0, 0, TrLater("Handles turn")},
    {Scope::kViews, Action::kScale, GLFW_KEY_R, 0, 0, TrLater("Handles scale")},
    {Scope::kViews, Action::kLayOnFloor, GLFW_KEY_F, 0, 0, TrLater("Lays the stage on the floor")},
    {Scope::kViews, Action::kLight, GLFW_KEY_L, 0, 0, TrLater("Selects the light probe")},
    {Scope::kViews, Action::kMatches, GLFW_KEY_T, 0, 0,
     TrLater("Shows the points that the camera is located by")},
    {Scope::kViews, Action::kOccluders, GLFW_KEY_O, 0, 0,
     TrLater("Shows the occluders over the camera's picture")},
    {Scope::kViews, Action::kWipe, GLFW_KEY_B, 0, 0,
     TrLater("Shows the camera's image alone to the left of a line that you drag")},
    {Scope::kViews, Action::kOnion, GLFW_KEY_K, 0, 0,
     TrLater("Shows people at moments before and after, too")},
    {Scope::kViews, Action::kOnionMore, GLFW_KEY_K, kShift, 0,
     TrLater("At how many moments, and how far apart")},
    {Scope::kViews, Action::kSound, GLFW_KEY_M, 0, 0, TrLater("Switches sound on and off")},
    {Scope::kViews, Action::kPointColours, GLFW_KEY_C, 0, 0,
     TrLater("Colours the points by something else")},
    {Scope::kViews, Action::kMeasure, GLFW_KEY_D, 0, 0,
     TrLater("Measures the distance of two points")},
    {Scope::kViews, Action::kSnapHandles, GLFW_KEY_N, 0, 0,
     TrLater("Handles move in steps; or hold Ctrl while dragging")},
    {Scope::kViews, Action::kFrameBack, 0, 0, U',', TrLater("One frame of the recording back")},
    {Scope::kViews, Action::kFrameOn, 0, 0, U'.', TrLater("One frame of the recording on")},
    {Scope::kViews, Action::kUnselect, GLFW_KEY_ESCAPE, 0, 0,
     TrLater(
         "Adds no more points of a model; unselects the points around the place; puts back what "
         "is being dragged")},

    {Scope::kCamera, Action::kNudgeLeft, GLFW_KEY_LEFT, 0, 0,
     TrLater("Moves the camera to the left by 5 mm"), TrLater("by 5 cm")},
    {Scope::kCamera, Action::kNudgeRight, GLFW_KEY_RIGHT, 0, 0, TrLater("To the right"),
     TrLater("by 5 cm")},
    {Scope::kCamera, Action::kNudgeUp, GLFW_KEY_UP, 0, 0, TrLater("Up"), TrLater("by 5 cm")},
    {Scope::kCamera, Action::kNudgeDown, GLFW_KEY_DOWN, 0, 0, TrLater("Down"), TrLater("by 5 cm")},
    {Scope::kCamera, Action::kNudgeForward, GLFW_KEY_PAGE_UP, 0, 0, TrLater("Forward"),
     TrLater("by 5 cm")},
    {Scope::kCamera, Action::kNudgeBack, GLFW_KEY_PAGE_DOWN, 0, 0, TrLater("Back"),
     TrLater("by 5 cm")},

    {Scope::kAround, Action::kOrbitLeft, GLFW_KEY_LEFT, 0, 0,
     TrLater("Goes round the place to the left"), TrLater("moves that way")},
    {Scope::kAround, Action::kOrbitRight, GLFW_KEY_RIGHT, 0, 0, TrLater("To the right"),
     TrLater("moves that way")},
    {Scope::kAround, Action::kOrbitUp, GLFW_KEY_UP, 0, 0, TrLater("Higher"),
     TrLater("moves that way")},
    {Scope::kAround, Action::kOrbitDown, GLFW_KEY_DOWN, 0, 0, TrLater("Lower"),
     TrLater("moves that way")},
    {Scope::kAround, Action::kComeNearer, GLFW_KEY_PAGE_UP, 0, 0, TrLater("Nearer")},
    {Scope::kAround, Action::kGoFurther, GLFW_KEY_PAGE_DOWN, 0, 0, TrLater("Further")},
    {Scope::kAround, Action::kLookAtStage, GLFW_KEY_HOME, 0, 0,
     TrLater("Looks at the stage as at first"), TrLater("at all of the map")},
    {Scope::kAround, Action::kLookAtSelected, GLFW_KEY_V, 0, 0,
     TrLater("Looks at what is selected")},

    {Scope::kPicks, Action::kImageBefore, GLFW_KEY_LEFT, 0, 0,
     TrLater("To the training image before"), TrLater("ten before")},
    {Scope::kPicks, Action::kImageAfter, GLFW_KEY_RIGHT, 0, 0, TrLater("To the next one"),
     TrLater("ten further")},
    {Scope::kPicks, Action::kPickedBefore, GLFW_KEY_PAGE_UP, 0, 0,
     TrLater("To the image before that has a pick of the point")},
    {Scope::kPicks, Action::kPickedAfter, GLFW_KEY_PAGE_DOWN, 0, 0,
     TrLater("To the next image that has one")},
    {Scope::kPicks, Action::kRemovePick, GLFW_KEY_DELETE, 0, 0,
     TrLater("Removes the point's pick in this image")},
    {Scope::kPicks, Action::kRemovePick, GLFW_KEY_BACKSPACE, 0, 0, nullptr},

    {Scope::kWalk, Action::kWalkLeft, GLFW_KEY_LEFT, 0, 0,
     TrLater("Moves it to the left over the floor by 1 cm"), TrLater("by 10 cm")},
    {Scope::kWalk, Action::kWalkRight, GLFW_KEY_RIGHT, 0, 0, TrLater("To the right"),
     TrLater("by 10 cm")},
    {Scope::kWalk, Action::kWalkAway, GLFW_KEY_UP, 0, 0, TrLater("Away"), TrLater("by 10 cm")},
    {Scope::kWalk, Action::kWalkNearer, GLFW_KEY_DOWN, 0, 0, TrLater("Towards you"),
     TrLater("by 10 cm")},
    {Scope::kWalk, Action::kLeaveWalk, GLFW_KEY_ESCAPE, 0, 0,
     TrLater("Lets go of it; a drag is not done")},

    {Scope::kLight, Action::kLightLeft, 0, 0, U'[',
     TrLater("Turns the light to the left by 1\xc2\xb0")},
    {Scope::kLight, Action::kLightRight, 0, 0, U']', TrLater("To the right")},
    {Scope::kLight, Action::kLightFarLeft, 0, 0, U'{', TrLater("To the left by 10\xc2\xb0")},
    {Scope::kLight, Action::kLightFarRight, 0, 0, U'}', TrLater("To the right by 10\xc2\xb0")},
    {Scope::kLight, Action::kDarker, 0, 0, U'-', TrLater("Darker by a sixth of a stop")},
    {Scope::kLight, Action::kBrighter, 0, 0, U'+', TrLater("Brighter")},
    {Scope::kLight, Action::kBrighter, 0, 0, U'=', nullptr},
    {Scope::kLight, Action::kPickGrey, GLFW_KEY_G, 0, 0, TrLater("Picks a grey surface")},
    {Scope::kLight, Action::kPickDirection, GLFW_KEY_M, 0, 0, TrLater("Matches a direction")},
    {Scope::kLight, Action::kStopPicking, GLFW_KEY_ESCAPE, 0, 0, TrLater("Picks no more")},

    {Scope::kTimeline, Action::kBack, GLFW_KEY_LEFT, 0, 0, TrLater("One frame back"),
     TrLater("a second")},
    {Scope::kTimeline, Action::kOn, GLFW_KEY_RIGHT, 0, 0, TrLater("One frame on"),
     TrLater("a second")},
    {Scope::kTimeline, Action::kBegin, GLFW_KEY_HOME, 0, 0, TrLater("To the beginning")},
    {Scope::kTimeline, Action::kEnd, GLFW_KEY_END, 0, 0, TrLater("To the end")},
    {Scope::kTimeline, Action::kEdgeBack, GLFW_KEY_PAGE_UP, 0, 0,
     TrLater("To where something began or ended before")},
    {Scope::kTimeline, Action::kEdgeOn, GLFW_KEY_PAGE_DOWN, 0, 0,
     TrLater("To where something begins or ends next")},
    {Scope::kTimeline, Action::kNearer, 0, 0, U'+', TrLater("Nearer")},
    {Scope::kTimeline, Action::kNearer, 0, 0, U'=', nullptr},
    {Scope::kTimeline, Action::kFurther, 0, 0, U'-', TrLater("Further")},
    {Scope::kTimeline, Action::kFit, 0, 0, U'0', TrLater("All of the drama")},
    {Scope::kTimeline, Action::kAdd, GLFW_KEY_A, 0, 0, TrLater("Adds an item at the playhead")},
    {Scope::kTimeline, Action::kMarker, GLFW_KEY_M, 0, 0, TrLater("Sets a marker at the playhead")},
    {Scope::kTimeline, Action::kSnap, GLFW_KEY_N, 0, 0, TrLater("Switches snapping on and off")},
    {Scope::kTimeline, Action::kRipple, GLFW_KEY_R, 0, 0, TrLater("Switches ripple on and off")},
    {Scope::kTimeline, Action::kTrimBegin, 0, 0, U'[',
     TrLater("What is chosen begins at the playhead")},
    {Scope::kTimeline, Action::kTrimEnd, 0, 0, U']',
     TrLater("What is chosen ends at the playhead")},
    {Scope::kTimeline, Action::kItemBack, GLFW_KEY_LEFT, kAlt, 0,
     TrLater("Moves what is chosen back by 0.1 s"), TrLater("by a second")},
    {Scope::kTimeline, Action::kItemOn, GLFW_KEY_RIGHT, kAlt, 0,
     TrLater("Moves what is chosen on by 0.1 s"), TrLater("by a second")},
    {Scope::kTimeline, Action::kSelectBefore, GLFW_KEY_LEFT, kCtrl, 0,
     TrLater("Chooses the item before"), TrLater("adds it")},
    {Scope::kTimeline, Action::kSelectAfter, GLFW_KEY_RIGHT, kCtrl, 0,
     TrLater("Chooses the item after"), TrLater("adds it")},
    {Scope::kTimeline, Action::kSelectAbove, GLFW_KEY_UP, kCtrl, 0,
     TrLater("Chooses one in the lane above"), TrLater("adds it")},
    {Scope::kTimeline, Action::kSelectBelow, GLFW_KEY_DOWN, kCtrl, 0,
     TrLater("Chooses one in the lane below"), TrLater("adds it")},
    {Scope::kTimeline, Action::kSelectAll, GLFW_KEY_A, kCtrl, 0, TrLater("Chooses all")},
    {Scope::kTimeline, Action::kSelectNone, GLFW_KEY_ESCAPE, 0, 0, TrLater("Chooses nothing")},
    {Scope::kTimeline, Action::kFold, GLFW_KEY_F, 0, 0,
     TrLater("Folds the lanes of whose item is chosen, and unfolds them"), TrLater("all lanes")},
    {Scope::kTimeline, Action::kCut, GLFW_KEY_X, kCtrl, 0, TrLater("Cuts")},
    {Scope::kTimeline, Action::kCopy, GLFW_KEY_C, kCtrl, 0, TrLater("Copies")},
    {Scope::kTimeline, Action::kPaste, GLFW_KEY_V, kCtrl, 0, TrLater("Pastes at the playhead")},
    {Scope::kTimeline, Action::kDuplicate, GLFW_KEY_D, kCtrl, 0, TrLater("Duplicates")},
    {Scope::kTimeline, Action::kDelete, GLFW_KEY_DELETE, 0, 0, TrLater("Deletes")},
    {Scope::kTimeline, Action::kDelete, GLFW_KEY_BACKSPACE, 0, 0, nullptr},
    {Scope::kTimeline, Action::kGoToScript, GLFW_KEY_ENTER, 0, 0,
     TrLater("Goes to the line in the script")},
});

bool Matches(const KeyBinding& binding, const KeyPress& press) {
  const int held = press.modifiers & kKnownModifiers;
  if (binding.character != 0) {
    // Shift and similar keys are part of typing the character.
    return press.character == binding.character && (held & kCtrl) == binding.modifiers;
  }
  const int may_be_held = binding.with_shift != nullptr ? kShift : 0;
  return press.key == binding.key && (held & ~may_be_held) == binding.modifiers;
}

const KeyBinding* FirstOf(KeyAction action) {
  const auto found =
      std::find_if(kBindings.begin(), kBindings.end(),
                   [&](const KeyBinding& binding) { return binding.action == action; });
  return found != kBindings.end() ? &*found : nullptr;
}

std::string KeyName(int key) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return Tr("Space");
    case GLFW_KEY_TAB:
      return Tr("Tab");
    case GLFW_KEY_ENTER:
      return Tr("Enter");
    case GLFW_KEY_ESCAPE:
      return Tr("Escape");
    case GLFW_KEY_DELETE:
      return TrIn("key", "Delete");
    case GLFW_KEY_BACKSPACE:
      return Tr("Backspace");
    case GLFW_KEY_LEFT:
      return Tr("Left");
    case GLFW_KEY_RIGHT:
      return Tr("Right");
    case GLFW_KEY_UP:
      return Tr("Up");
    case GLFW_KEY_DOWN:
      return Tr("Down");
    case GLFW_KEY_HOME:
      return Tr("Home");
    case GLFW_KEY_END:
      return Tr("End");
    case GLFW_KEY_PAGE_UP:
      return Tr("Page Up");
    case GLFW_KEY_PAGE_DOWN:
      return Tr("Page Down");
    default:
      break;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) {
    return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  }
  return {static_cast<char>(key)};  // GLFW's codes of letters and digits are ASCII.
}

}  // namespace

std::span<const KeyBinding> KeyBindings() { return kBindings; }

KeyAction ActionOf(KeyScope scope, const KeyPress& press) {
  for (const KeyBinding& binding : kBindings) {
    if (binding.scope == scope && Matches(binding, press)) {
      return binding.action;
    }
  }
  return Action::kNone;
}

std::string KeyText(const KeyBinding& binding) {
  std::string text;
  for (const auto& [modifier, name] :
       {std::pair{kCtrl, Tr("Ctrl")}, {kAlt, Tr("Alt")}, {kShift, Tr("Shift")}}) {
    if ((binding.modifiers & modifier) != 0) {
      text += std::string(name) + "+";
    }
  }
  return text + (binding.character != 0 ? std::string{static_cast<char>(binding.character)}
                                        : KeyName(binding.key));
}

std::string KeyText(KeyAction action) {
  const KeyBinding* binding = FirstOf(action);
  return binding != nullptr ? KeyText(*binding) : "";
}

std::string TextOf(KeyAction action) {
  const KeyBinding* binding = FirstOf(action);
  return binding != nullptr ? Tr(binding->does) : "";
}

std::string WithKey(const char* text, KeyAction action) {
  return std::string(text) + " (" + KeyText(action) + ")";
}

bool AltTap::Ends(int key, int action) {
  const bool alt = key == GLFW_KEY_LEFT_ALT;  // The right Alt types characters on many keyboards.
  if (alt && action == GLFW_RELEASE) {
    return std::exchange(alone_, false);
  }
  if (action == GLFW_PRESS) {
    alone_ = alt;
  }
  return false;
}

const char* ScopeTitle(KeyScope scope) {
  switch (scope) {
    case Scope::kStart:
      return Tr("On the start page");
    case Scope::kAlways:
      return Tr("Everywhere");
    case Scope::kPanels:
      return Tr("In panels, menus and dialogs");
    case Scope::kViews:
      return Tr("In the views");
    case Scope::kCamera:
      return Tr("Through the camera");
    case Scope::kAround:
      return Tr("Around the place");
    case Scope::kPicks:
      return Tr("Among the picks");
    case Scope::kWalk:
      return Tr("While the end of a walk is chosen");
    case Scope::kLight:
      return Tr("While a light probe is selected");
    case Scope::kTimeline:
      return Tr("In the timeline");
  }
  return "";
}

}  // namespace lararium::panels
