#include "editor/session/message_log.h"

#include <algorithm>
#include <utility>

#include "editor/text/text.h"

namespace lararium::editor {

void MessageLog::Tell(Message::Level level, std::string text) {
  constexpr size_t kMaxEntries = 200;
  if (!entries_.empty() && entries_.back().text == text) {
    return;
  }
  entries_.push_back({level, std::move(text)});
  ++told_;
  if (entries_.size() > kMaxEntries) {
    entries_.pop_front();
  }
}

void MessageLog::Warn(const std::string& text) {
  if (std::ranges::none_of(entries_, [&](const Message& m) { return m.text == text; })) {
    Tell(Message::Level::kWarning, text);
  }
}

bool MessageLog::TellFailure(const Status& status) {
  if (!status.ok()) {
    Tell(Message::Level::kError, status.message());
  }
  return !status.ok();
}

void MessageLog::Report(const Status& status, bool cancelled, const std::string& success) {
  if (cancelled) {
    Tell(Message::Level::kInfo, Tr("Cancelled. Nothing was changed."));
  } else if (!TellFailure(status)) {
    Tell(Message::Level::kInfo, success);
  }
}

}  // namespace lararium::editor
