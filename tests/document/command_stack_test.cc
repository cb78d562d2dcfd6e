#include "editor/document/command_stack.h"

#include <gtest/gtest.h>

#include <string>

namespace lararium::editor {
namespace {

using Stack = CommandStack<std::string>;

void Append(Stack& stack, const std::string& text, std::string_view gesture = {}) {
  stack.Edit(
      "append " + text, [&](std::string& document) { document += text; }, gesture);
}

TEST(CommandStack, UndoAndRedoWalkThroughEveryState) {
  Stack stack("");
  Append(stack, "a");
  Append(stack, "b");
  EXPECT_EQ(stack.document(), "ab");
  EXPECT_EQ(stack.undo_name().English(), "append b");
  stack.Undo();
  EXPECT_EQ(stack.document(), "a");
  EXPECT_EQ(stack.redo_name().English(), "append b");
  stack.Undo();
  EXPECT_EQ(stack.document(), "");
  EXPECT_FALSE(stack.CanUndo());
  stack.Redo();
  stack.Redo();
  EXPECT_EQ(stack.document(), "ab");
  EXPECT_FALSE(stack.CanRedo());
}

TEST(CommandStack, ANewEditDropsWhatWasUndone) {
  Stack stack("");
  Append(stack, "a");
  stack.Undo();
  Append(stack, "c");
  EXPECT_EQ(stack.document(), "c");
  EXPECT_FALSE(stack.CanRedo());
}

TEST(CommandStack, WhatIsRewrittenIsSoInAllThatUndoAndRedoBringBack) {
  Stack stack("x");
  Append(stack, "a");
  Append(stack, "x");
  Append(stack, "b");
  stack.Undo();
  stack.MarkSaved();
  stack.Rewrite([](std::string& document) { std::erase(document, 'x'); });
  EXPECT_EQ(stack.document(), "a");
  EXPECT_TRUE(stack.dirty());
  stack.Redo();
  EXPECT_EQ(stack.document(), "ab");
  stack.Undo();
  stack.Undo();
  EXPECT_EQ(stack.document(), "a");
  stack.Undo();
  EXPECT_EQ(stack.document(), "");
  EXPECT_TRUE(stack.dirty());
}

TEST(CommandStack, OneGestureIsOneCommand) {
  Stack stack("");
  Append(stack, "a");
  Append(stack, "1", "drag");
  Append(stack, "2", "drag");
  Append(stack, "3", "drag");
  EXPECT_EQ(stack.document(), "a123");
  stack.Undo();
  EXPECT_EQ(stack.document(), "a");
  stack.Redo();
  EXPECT_EQ(stack.document(), "a123");
}

TEST(CommandStack, AGestureThatIsGivenUpWasNeverThere) {
  Stack stack("");
  Append(stack, "a");
  stack.MarkSaved();
  Append(stack, "1", "drag");
  Append(stack, "2", "drag");
  EXPECT_TRUE(stack.in_gesture());
  stack.CancelGesture();
  EXPECT_EQ(stack.document(), "a");
  EXPECT_FALSE(stack.in_gesture());
  EXPECT_FALSE(stack.dirty());
  EXPECT_FALSE(stack.CanRedo());
  EXPECT_EQ(stack.undo_name().English(), "append a");
}

TEST(CommandStack, ANewGestureIsANewCommand) {
  Stack stack("");
  Append(stack, "1", "drag");
  stack.EndGesture();
  Append(stack, "2", "drag");
  Append(stack, "3", "other");
  stack.Undo();
  EXPECT_EQ(stack.document(), "12");
  stack.Undo();
  EXPECT_EQ(stack.document(), "1");
}

TEST(CommandStack, GesturesDoNotContinueAcrossUndo) {
  Stack stack("");
  Append(stack, "1", "drag");
  Append(stack, "x");
  stack.Undo();
  Append(stack, "2", "drag");
  stack.Undo();
  EXPECT_EQ(stack.document(), "1");
}

TEST(CommandStack, UndoingBackToTheSavedStateIsClean) {
  Stack stack("");
  EXPECT_FALSE(stack.dirty());
  Append(stack, "a");
  EXPECT_TRUE(stack.dirty());
  stack.MarkSaved();
  EXPECT_FALSE(stack.dirty());
  Append(stack, "b");
  stack.Undo();
  EXPECT_FALSE(stack.dirty());
  stack.Undo();
  EXPECT_TRUE(stack.dirty());
}

TEST(CommandStack, ForgetsTheOldestBeyondItsLimit) {
  CommandStack<int> stack(0);
  const int edits = static_cast<int>(CommandStack<int>::kMaxCommands) + 5;
  for (int i = 1; i <= edits; ++i) {
    stack.Edit(Sentence("count"), [&](int& value) { value = i; });
  }
  while (stack.CanUndo()) {
    stack.Undo();
  }
  EXPECT_EQ(stack.document(), 5);
}

}  // namespace
}  // namespace lararium::editor
