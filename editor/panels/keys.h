#pragma once

// The keys of the editor: one table, by which panels know what a key means and which the list
// of keys (F1) shows.

#include <span>
#include <string>

namespace lararium::panels {

// A key that went down or repeats; GLFW's codes, letters by what is printed on the key. ImGui
// 1.86 looks at the state of keys once a frame and misses what is pressed and released in
// between.
struct KeyPress {
  int key = 0;
  int modifiers = 0;
  bool repeats = false;    // it was held down
  char32_t character = 0;  // that it types; 0: none
};

// Where a key means something. A press is ImGui's while it walks the panels (KeyboardFocus), else
// it is offered to the timeline while that was clicked last, then to the light while a probe is
// selected, then to the end of a walk while one is chosen, then to the view that is shown (the
// camera's, around the place, the picks) and to the rest.
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
  // the start page
  kNewProject,
  kNewFromImages,
  kNewFromCamera,
  kNewEmpty,
  kOpenProject,
  // always
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
  // walking through panels, menus and dialogs
  kWalkOn,
  kPress,
  kFieldAfter,
  kStopWalking,
  // the views
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
  // the camera view
  kNudgeLeft,
  kNudgeRight,
  kNudgeUp,
  kNudgeDown,
  kNudgeForward,
  kNudgeBack,
  // the view around the place
  kOrbitLeft,
  kOrbitRight,
  kOrbitUp,
  kOrbitDown,
  kComeNearer,
  kGoFurther,
  kLookAtStage,
  kLookAtSelected,
  // the picks
  kImageBefore,
  kImageAfter,
  kPickedBefore,
  kPickedAfter,
  kRemovePick,
  // the end of a walk
  kWalkLeft,
  kWalkRight,
  kWalkAway,
  kWalkNearer,
  kLeaveWalk,
  // a light probe
  kLightLeft,
  kLightRight,
  kLightFarLeft,
  kLightFarRight,
  kDarker,
  kBrighter,
  kPickGrey,
  kPickDirection,
  kStopPicking,
  // the timeline
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
  int key;             // GLFW's; 0: the character counts, wherever the keyboard has it
  int modifiers;       // GLFW's, of Control, Shift and Alt; with a character only Control counts
  char32_t character;  // 0: the key counts
  const char* does;    // English, see Tr(); nullptr: as the binding of the same action before it
  const char* with_shift = nullptr;  // Shift may be held as well, and does this more; English
};

// Bindings of one scope and of one action follow one another.
std::span<const KeyBinding> KeyBindings();

// What a press means in a scope; kNone: nothing.
KeyAction ActionOf(KeyScope scope, const KeyPress& press);

// "Ctrl+Shift+Z", in the language of the interface.
std::string KeyText(const KeyBinding& binding);
// The first binding of an action, for menus and tooltips.
std::string KeyText(KeyAction action);
// What an action does, in the language of the interface.
std::string TextOf(KeyAction action);
// "Plays (Space)".
std::string WithKey(const char* text, KeyAction action);

const char* ScopeTitle(KeyScope scope);

// Tells when Alt is pressed and let go, and nothing else meanwhile: that opens the menus.
class AltTap {
 public:
  // Of every event of a key, with GLFW's codes. True when that was a tap.
  bool Ends(int key, int action);
  // A button of the mouse was pressed.
  void Cancel() { alone_ = false; }

 private:
  bool alone_ = false;
};

}  // namespace lararium::panels
