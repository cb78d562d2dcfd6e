#pragma once

// Undo and redo. A document is an immutable value; an edit makes the next one, and the stack keeps
// them all. Unchanged sub-objects can be shared. Data that is too large to be copied with each
// edit, such as a text, lies outside the document and is changed by patches: commands store the
// patches, and the owner of the data applies them.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "shared/core/check.h"
#include "shared/core/sentence.h"

namespace lararium::editor {

template <typename Document, typename Patch = std::monostate>
class CommandStack {
 public:
  using Snapshot = std::shared_ptr<const Document>;

  // The number of edits that can be undone; older ones are forgotten.
  static constexpr size_t kMaxCommands = 1000;
  // Limit of all patches together; older commands are forgotten.
  static constexpr size_t kMaxPatchBytes = 256 << 20;

  explicit CommandStack(Document document)
      : current_(std::make_shared<const Document>(std::move(document))), saved_(current_) {}

  const Document& document() const { return *current_; }
  const Snapshot& snapshot() const { return current_; }

  // Applies one edit. name: is shown for undo and redo, in the language at that time. Consecutive
  // edits with the same non-empty gesture (one drag of a handle or of a number) become one command:
  // undo returns to the state before the gesture.
  void Edit(Sentence name,
            const std::function<void(Document&)>& change,
            std::string_view gesture = {}) {
    Document next = *current_;
    change(next);
    Push(std::move(name), std::move(next), gesture);
  }

  // Records an edit that is a patch, which the caller has already applied. bytes: the memory that
  // the patch holds.
  void EditPatched(Sentence name, Patch patch, size_t bytes, std::string_view gesture = {}) {
    Push(std::move(name), *current_, gesture);
    undo_.back().patches.push_back(std::move(patch));
    undo_.back().bytes += bytes;
    bytes_ += bytes;
    while (bytes_ > kMaxPatchBytes && undo_.size() > 1) {
      ForgetOldest();
    }
  }

  // Changes the document and every document that undo and redo can restore, for a fact on disk that
  // cannot be undone. Afterwards no state counts as saved.
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

  // Ends the gesture: the next edit becomes a separate command.
  void EndGesture() { gesture_.clear(); }
  bool in_gesture() const { return !gesture_.empty(); }
  // Restores the document as it was before the gesture and forgets its command. Returns the
  // patches; the caller must apply their reverse from the last to the first. Only within a gesture.
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
  // The name of the command that Undo() or Redo() would take. Requires CanUndo() or CanRedo().
  const Sentence& undo_name() const { return (CHECK(CanUndo()), undo_.back().name); }
  const Sentence& redo_name() const { return (CHECK(CanRedo()), redo_.back().name); }

  // Both return the command's patches in the order in which they were made. After Undo() the caller
  // must apply their reverse from the last to the first. The span is valid until the next call.
  std::span<const Patch> Undo() { return Step(undo_, redo_); }
  std::span<const Patch> Redo() { return Step(redo_, undo_); }

  // Whether the document differs from the one at the last MarkSaved(). Undoing back to that state
  // makes it clean again.
  bool dirty() const { return current_ != saved_; }
  void MarkSaved() { saved_ = current_; }
  // No state counts as saved any more (the document was recovered after a crash).
  void MarkUnsaved() { saved_ = nullptr; }

 private:
  struct Command {
    Sentence name;
    Snapshot other_side;  // The document before the command (in undo_) or after it (in redo_).
    std::vector<Patch> patches = {};
    size_t bytes = 0;  // Memory that the patches hold.
  };

  void Push(Sentence name, Document next, std::string_view gesture) {
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
  size_t bytes_ = 0;  // Memory that all patches of undo_ and redo_ hold.
};

}  // namespace lararium::editor
