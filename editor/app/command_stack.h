#pragma once

// Undo and redo. A document is an immutable value; an edit makes the next one,
// and the stack keeps them all. Sub-objects that did not change may be shared.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shared/core/check.h"

namespace lararium::app {

template <typename Document>
class CommandStack {
 public:
  using Snapshot = std::shared_ptr<const Document>;

  // How many edits can be undone; older ones are forgotten.
  static constexpr size_t kMaxCommands = 1000;

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
    const bool continues = !gesture.empty() && gesture == gesture_ && !undo_.empty();
    if (!continues) {
      undo_.push_back({std::move(name), current_});
    }
    if (undo_.size() > kMaxCommands) {
      undo_.erase(undo_.begin());
    }
    redo_.clear();
    gesture_ = gesture;
    current_ = std::make_shared<const Document>(std::move(next));
  }

  // The gesture is over: the next edit is a command of its own.
  void EndGesture() { gesture_.clear(); }

  bool CanUndo() const { return !undo_.empty(); }
  bool CanRedo() const { return !redo_.empty(); }
  // Name of the command that Undo() or Redo() would take. Only where there is one.
  const std::string& undo_name() const { return (CHECK(CanUndo()), undo_.back().name); }
  const std::string& redo_name() const { return (CHECK(CanRedo()), redo_.back().name); }

  void Undo() { Step(undo_, redo_); }
  void Redo() { Step(redo_, undo_); }

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
  };

  void Step(std::vector<Command>& from, std::vector<Command>& to) {
    CHECK(!from.empty());
    EndGesture();
    Command command = std::move(from.back());
    from.pop_back();
    std::swap(command.other_side, current_);
    to.push_back(std::move(command));
  }

  Snapshot current_;
  Snapshot saved_;
  std::vector<Command> undo_;
  std::vector<Command> redo_;
  std::string gesture_;
};

}  // namespace lararium::app
