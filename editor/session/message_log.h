#pragma once

// The messages of an open project, for the status bar and the list of messages.

#include <cstdint>
#include <deque>
#include <string>

#include "shared/core/status.h"

namespace lararium::editor {

struct Message {
  enum class Level { kInfo, kWarning, kError };
  Level level = Level::kInfo;
  std::string text;  // The text in the language of the interface.
};

class MessageLog {
 public:
  // The newest messages, oldest first.
  const std::deque<Message>& entries() const { return entries_; }
  // The number of all messages so far, including those that were removed from entries().
  uint64_t told() const { return told_; }

  // Adds a message, unless it repeats the newest one.
  void Tell(Message::Level level, std::string text);
  // Adds a warning, unless one of entries() says it already.
  void Warn(const std::string& text);
  // Adds an error message where the status is a failure. Returns whether it is.
  bool TellFailure(const Status& status);
  // Adds the result of a task: success is the text where the task was neither cancelled nor failed.
  void Report(const Status& status, bool cancelled, const std::string& success);

 private:
  std::deque<Message> entries_;
  uint64_t told_ = 0;
};

}  // namespace lararium::editor
