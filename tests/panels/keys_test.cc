#include "editor/panels/widgets/keys.h"

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace lararium::panels {
namespace {

// The key press for a binding.
KeyPress PressOf(const KeyBinding& binding, int more = 0) {
  return {binding.key, binding.modifiers | more, false, binding.character};
}

TEST(Keys, EveryBindingOfTheTableIsWhatItsKeyDoes) {
  for (const KeyBinding& binding : KeyBindings()) {
    EXPECT_EQ(ActionOf(binding.scope, PressOf(binding)), binding.action) << KeyText(binding);
    EXPECT_EQ(ActionOf(binding.scope, PressOf(binding, GLFW_MOD_CAPS_LOCK | GLFW_MOD_NUM_LOCK)),
              binding.action)
        << KeyText(binding);
  }
}

TEST(Keys, NoKeyMeansTwoThingsInOneScope) {
  for (const KeyBinding& a : KeyBindings()) {
    for (const KeyBinding& b : KeyBindings()) {
      if (a.scope == b.scope && a.action != b.action && a.with_shift != nullptr) {
        EXPECT_NE(ActionOf(b.scope, PressOf(a, GLFW_MOD_SHIFT)), b.action) << KeyText(a);
      }
    }
  }
  std::set<std::pair<KeyScope, std::string>> texts;
  for (const KeyBinding& binding : KeyBindings()) {
    EXPECT_TRUE(texts.insert({binding.scope, KeyText(binding)}).second) << KeyText(binding);
  }
}

TEST(Keys, NoKeyThatWorksEverywhereIsHiddenByTheViews) {
  for (const KeyScope scope : {KeyScope::kViews, KeyScope::kCamera, KeyScope::kAround,
                               KeyScope::kPicks, KeyScope::kWalk, KeyScope::kLight}) {
    for (const KeyBinding& binding : KeyBindings()) {
      if (binding.scope == scope) {
        EXPECT_EQ(ActionOf(KeyScope::kAlways, PressOf(binding)), KeyAction::kNone)
            << KeyText(binding);
      }
    }
  }
}

TEST(Keys, ThoseOfOneViewMeanNothingElseInAllOfThem) {
  // Presses are offered to both scopes.
  for (const KeyScope scope : {KeyScope::kCamera, KeyScope::kAround, KeyScope::kPicks}) {
    for (const KeyBinding& binding : KeyBindings()) {
      if (binding.scope == scope) {
        EXPECT_EQ(ActionOf(KeyScope::kViews, PressOf(binding)), KeyAction::kNone)
            << KeyText(binding);
        EXPECT_EQ(ActionOf(KeyScope::kLight, PressOf(binding)), KeyAction::kNone)
            << KeyText(binding);
      }
    }
  }
}

TEST(Keys, EveryActionSaysOnceWhatItDoesAndItsBindingsFollowOneAnother) {
  std::set<KeyAction> said;
  KeyAction before = KeyAction::kNone;
  for (const KeyBinding& binding : KeyBindings()) {
    if (binding.does != nullptr) {
      EXPECT_TRUE(said.insert(binding.action).second) << KeyText(binding);
      EXPECT_STRNE(binding.does, "");
    } else {
      EXPECT_EQ(binding.action, before) << KeyText(binding);
    }
    before = binding.action;
  }
  for (int action = 1; action <= static_cast<int>(KeyAction::kGoToScript); ++action) {
    EXPECT_TRUE(said.contains(static_cast<KeyAction>(action))) << action;
  }
}

TEST(Keys, ShiftIsPartOfAKeyUnlessTheTableSaysThatItDoesMore) {
  EXPECT_EQ(ActionOf(KeyScope::kAlways, {GLFW_KEY_Z, GLFW_MOD_CONTROL, false, 0}),
            KeyAction::kUndo);
  EXPECT_EQ(ActionOf(KeyScope::kAlways, {GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, false, 0}),
            KeyAction::kRedo);
  EXPECT_EQ(ActionOf(KeyScope::kAlways, {GLFW_KEY_S, GLFW_MOD_CONTROL | GLFW_MOD_ALT, false, 0}),
            KeyAction::kNone);
  EXPECT_EQ(ActionOf(KeyScope::kTimeline, {GLFW_KEY_LEFT, GLFW_MOD_SHIFT, false, 0}),
            KeyAction::kBack);
  EXPECT_EQ(ActionOf(KeyScope::kTimeline, {GLFW_KEY_LEFT, GLFW_MOD_SHIFT | GLFW_MOD_ALT, false, 0}),
            KeyAction::kItemBack);
}

TEST(Keys, SignsCountWhereverTheKeyboardHasThem) {
  // "?" on an Italian and on an American keyboard.
  for (const int key : {GLFW_KEY_MINUS, GLFW_KEY_SLASH}) {
    EXPECT_EQ(ActionOf(KeyScope::kAlways, {key, GLFW_MOD_SHIFT, false, U'?'}), KeyAction::kKeyList);
  }
}

TEST(Keys, WhatWalksThroughPanelsNeverNeedsControlOrAlt) {
  // Such keys stay available to the whole window while a panel has the keyboard.
  for (const KeyBinding& binding : KeyBindings()) {
    if (binding.scope == KeyScope::kPanels) {
      EXPECT_EQ(binding.modifiers, 0) << KeyText(binding);
      EXPECT_EQ(binding.character, 0u) << KeyText(binding);
    }
  }
}

TEST(AltTap, IsAltPressedAndLetGoAlone) {
  AltTap tap;
  EXPECT_FALSE(tap.Ends(GLFW_KEY_LEFT_ALT, GLFW_PRESS));
  EXPECT_TRUE(tap.Ends(GLFW_KEY_LEFT_ALT, GLFW_RELEASE));
  EXPECT_FALSE(tap.Ends(GLFW_KEY_LEFT_ALT, GLFW_RELEASE)) << "once";
}

TEST(AltTap, IsNoneWhereAltWasHeldForAnotherKeyOrTheMouse) {
  AltTap tap;
  tap.Ends(GLFW_KEY_LEFT_ALT, GLFW_PRESS);
  tap.Ends(GLFW_KEY_LEFT, GLFW_PRESS);
  tap.Ends(GLFW_KEY_LEFT, GLFW_RELEASE);
  EXPECT_FALSE(tap.Ends(GLFW_KEY_LEFT_ALT, GLFW_RELEASE));
  tap.Ends(GLFW_KEY_LEFT_ALT, GLFW_PRESS);
  tap.Cancel();
  EXPECT_FALSE(tap.Ends(GLFW_KEY_LEFT_ALT, GLFW_RELEASE));
}

TEST(AltTap, LeavesTheKeyAloneThatTypesSigns) {
  AltTap tap;
  tap.Ends(GLFW_KEY_RIGHT_ALT, GLFW_PRESS);
  EXPECT_FALSE(tap.Ends(GLFW_KEY_RIGHT_ALT, GLFW_RELEASE));
}

TEST(Keys, AreWrittenAsPeopleWriteThem) {
  EXPECT_EQ(KeyText(KeyAction::kRedo), "Ctrl+Shift+Z");
  EXPECT_EQ(KeyText(KeyAction::kItemBack), "Alt+Left");
  EXPECT_EQ(KeyText(KeyAction::kKeyList), "F1");
  EXPECT_EQ(KeyText(KeyAction::kTrimBegin), "[");
  EXPECT_EQ(KeyText(KeyAction::kPanelBefore), "Ctrl+Shift+Tab");
  EXPECT_EQ(WithKey("Plays", KeyAction::kPlay), "Plays (Space)");
  EXPECT_EQ(TextOf(KeyAction::kPlay), "Plays and pauses");
}

}  // namespace
}  // namespace lararium::panels
