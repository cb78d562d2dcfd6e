#pragma once

// The keys of the editor: one table, which panels use to interpret keys and which the list of keys
// (F1) shows.

#include <span>
#include <string>

namespace lararium::panels {

// A key that was pressed or repeats; GLFW's codes, letters by the printed label. ImGui 1.86 samples
// the state of keys once per frame and misses keys that are pressed and released in between.
struct KeyPress {
  int key = 0;
  int modifiers = 0;
  bool repeats = false;    // The key was held down.
  char32_t character = 0;  // The character that it types; 0: none.
};

// Where a key has a meaning. ImGui handles a press while the keyboard moves the focus in panels
// (KeyboardFocus). Otherwise the press is offered in this order: to the timeline if it was clicked
// last, to the light if a probe is selected, to the end of a walk if one is selected, to the open
// view (camera view, scene view or picks), and to the rest.
enum class KeyScope {
  kStart,
  kAlways,
  kPanels,
  kViews,
  kCamera,
  kAround,
  kPicks,
  kWalk,
  kLight,
  kTimeline
};

enum class KeyAction {
  kNone,
  // Start page.
  kNewProject,
  kNewFromImages,
  kNewFromCamera,
  kNewEmpty,
  kOpenProject,
  // Always.
  kSave,
  kUndo,
  kRedo,
  kLeave,
  kQuit,
  kKeyList,
  kTimelineTab,
  kScriptTab,
  kChecksTab,
  kMessagesTab,
  kEvidence,
  kPlay,
  kPanelAfter,
  kPanelBefore,
  kMenus,
  kPanelSmaller,
  kPanelLarger,
  // Moving the focus in panels, menus and dialogs.
  kWalkOn,
  kPress,
  kFieldAfter,
  kStopWalking,
  // All views.
  kCameraView,
  kAroundView,
  kPickView,
  kMove,
  kTurn,
  kScale,
  kLayOnFloor,
  kLight,
  kMatches,
  kOccluders,
  kWipe,
  kOnion,
  kOnionMore,
  kSound,
  kPointColours,
  kMeasure,
  kSnapHandles,
  kFrameBack,
  kFrameOn,
  kUnselect,
  // Camera view.
  kNudgeLeft,
  kNudgeRight,
  kNudgeUp,
  kNudgeDown,
  kNudgeForward,
  kNudgeBack,
  // Scene view.
  kOrbitLeft,
  kOrbitRight,
  kOrbitUp,
  kOrbitDown,
  kComeNearer,
  kGoFurther,
  kLookAtStage,
  kLookAtSelected,
  // Picks.
  kImageBefore,
  kImageAfter,
  kPickedBefore,
  kPickedAfter,
  kRemovePick,
  // End of a walk.
  kWalkLeft,
  kWalkRight,
  kWalkAway,
  kWalkNearer,
  kLeaveWalk,
  // Light probe.
  kLightLeft,
  kLightRight,
  kLightFarLeft,
  kLightFarRight,
  kDarker,
  kBrighter,
  kPickGrey,
  kPickDirection,
  kStopPicking,
  // Timeline.
  kBack,
  kOn,
  kBegin,
  kEnd,
  kEdgeBack,
  kEdgeOn,
  kNearer,
  kFurther,
  kFit,
  kAdd,
  kMarker,
  kSnap,
  kRipple,
  kTrimBegin,
  kTrimEnd,
  kItemBack,
  kItemOn,
  kSelectBefore,
  kSelectAfter,
  kSelectAbove,
  kSelectBelow,
  kSelectAll,
  kSelectNone,
  kFold,
  kCut,
  kCopy,
  kPaste,
  kDuplicate,
  kDelete,
  kGoToScript,
};

struct KeyBinding {
  KeyScope scope;
  KeyAction action;
  int key;        // GLFW's code; 0: the character counts, independent of the keyboard layout.
  int modifiers;  // GLFW's bits of Control, Shift and Alt; with a character only Control counts.
  char32_t character;  // 0: the key counts.
  const char* does;    // English, see Tr(); nullptr: the text of the action's previous binding.
  const char* with_shift = nullptr;  // English; what Shift adds, if it may be held as well.
};

// Bindings of one scope, and of one action, are consecutive.
std::span<const KeyBinding> KeyBindings();

// The action of a press in a scope; kNone: it has none.
KeyAction ActionOf(KeyScope scope, const KeyPress& press);

// For example "Ctrl+Shift+Z", in the language of the interface.
std::string KeyText(const KeyBinding& binding);
// The text of an action's first binding, for menus and tooltips.
std::string KeyText(KeyAction action);
// The description of an action, in the language of the interface.
std::string TextOf(KeyAction action);
// For example "Plays (Space)".
std::string WithKey(const char* text, KeyAction action);

const char* ScopeTitle(KeyScope scope);

// Detects that Alt is pressed and released without other input, which opens the menus.
class AltTap {
 public:
  // Call for every key event, with GLFW's codes. Returns true when the event completes a tap.
  bool Ends(int key, int action);
  // Call when a mouse button is pressed.
  void Cancel() { alone_ = false; }

 private:
  bool alone_ = false;
};

}  // namespace lararium::panels
