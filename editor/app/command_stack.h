#pragma once

// Undo and redo. A document is an immutable value; an edit makes the next one,
// and the stack keeps them all. Sub-objects that did not change may be shared.
// What is too large to be kept whole, such as a text, lies beside the document and is
// changed by patches, which the commands keep and whoever owns the text applies.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "shared/core/check.h"

namespace lararium::app {

template <typename Document, typename Patch = std::monostate>
class CommandStack {
 public:
  using Snapshot = std::shared_ptr<const Document>;

  // How many edits can be undone; older ones are forgotten.
  static constexpr size_t kMaxCommands = 1000;
  static constexpr size_t kMaxPatchBytes = 256 << 20;  // likewise

  explicit CommandStack(Document document)
      : current_(std::make_shared<const Document>(std::move(document))), saved_(current_) {}

  const Document& document() const { return *current_; }
  const Snapshot& snapshot() const { return current_; }

  // Applies one edit. Consecutive edits with the same non-empty gesture (one drag
  // of a handle, one pull of a number) become one command: undo goes back to
  // where the gesture began.
  void Edit(std::string name,
            const std::function<void(Document&)>& change,
            std::string_view gesture = {}) {
    Document next = *current_;
    change(next);
    Push(std::move(name), std::move(next), gesture);
  }

  // The same for an edit that is a patch, which has been applied; bytes: that it holds.
  void EditPatched(std::string name, Patch patch, size_t bytes, std::string_view gesture = {}) {
    Push(std::move(name), *current_, gesture);
    undo_.back().patches.push_back(std::move(patch));
    undo_.back().bytes += bytes;
    bytes_ += bytes;
    while (bytes_ > kMaxPatchBytes && undo_.size() > 1) {
      ForgetOldest();
    }
  }

  // Changes the document and all that undo and redo would bring back: what has become true of
  // the files cannot be undone. A document that was saved is not saved as it is now.
  void Rewrite(const std::function<void(Document&)>& change) {
    const auto rewritten = [&](const Snapshot& snapshot) {
      Document next = *snapshot;
      change(next);
      return std::make_shared<const Document>(std::move(next));
    };
    EndGesture();
    current_ = rewritten(current_);
    saved_ = nullptr;
    for (std::vector<Command>* commands : {&undo_, &redo_}) {
      for (Command& command : *commands) {
        command.other_side = rewritten(command.other_side);
      }
    }
  }

  // The gesture is over: the next edit is a command of its own.
  void EndGesture() { gesture_.clear(); }
  bool in_gesture() const { return !gesture_.empty(); }
  // The document as it was before the gesture, whose command is forgotten. Gives the patches whose
  // reverse is to be applied, from the last to the first. Only within a gesture.
  std::vector<Patch> CancelGesture() {
    CHECK(in_gesture() && CanUndo());
    EndGesture();
    Command command = std::move(undo_.back());
    undo_.pop_back();
    current_ = std::move(command.other_side);
    bytes_ -= command.bytes;
    return std::move(command.patches);
  }

  bool CanUndo() const { return !undo_.empty(); }
  bool CanRedo() const { return !redo_.empty(); }
  // Name of the command that Undo() or Redo() would take. Only where there is one.
  const std::string& undo_name() const { return (CHECK(CanUndo()), undo_.back().name); }
  const std::string& redo_name() const { return (CHECK(CanRedo()), redo_.back().name); }

  // They give the command's patches in the order in which they were made: Undo() asks for
  // their reverse to be applied from the last to the first. Valid until the next call.
  std::span<const Patch> Undo() { return Step(undo_, redo_); }
  std::span<const Patch> Redo() { return Step(redo_, undo_); }

  // Whether the document differs from what MarkSaved() was last told of. Undoing
  // back to that state makes it clean again.
  bool dirty() const { return current_ != saved_; }
  void MarkSaved() { saved_ = current_; }
  // The document was never saved in its present state (recovered after a crash).
  void MarkUnsaved() { saved_ = nullptr; }

 private:
  struct Command {
    std::string name;
    Snapshot other_side;  // the document before it (undo) or after it (redo)
    std::vector<Patch> patches = {};
    size_t bytes = 0;  // of the patches
  };

  void Push(std::string name, Document next, std::string_view gesture) {
    const bool continues = !gesture.empty() && gesture == gesture_ && !undo_.empty();
    if (!continues) {
      undo_.push_back({std::move(name), current_});
    }
    if (undo_.size() > kMaxCommands) {
      ForgetOldest();
    }
    for (const Command& command : redo_) {
      bytes_ -= command.bytes;
    }
    redo_.clear();
    gesture_ = gesture;
    current_ = std::make_shared<const Document>(std::move(next));
  }

  void ForgetOldest() {
    bytes_ -= undo_.front().bytes;
    undo_.erase(undo_.begin());
  }

  std::span<const Patch> Step(std::vector<Command>& from, std::vector<Command>& to) {
    CHECK(!from.empty());
    EndGesture();
    Command command = std::move(from.back());
    from.pop_back();
    std::swap(command.other_side, current_);
    to.push_back(std::move(command));
    return to.back().patches;
  }

  Snapshot current_;
  Snapshot saved_;
  std::vector<Command> undo_;
  std::vector<Command> redo_;
  std::string gesture_;
  size_t bytes_ = 0;  // of all patches
};

}  // namespace lararium::app
