#include "player/kiosk/recent_warnings.h"

#include <spdlog/logger.h>

#include <string_view>

namespace lararium::player {
namespace {

// Cuts a text to its first line and to kMostBytes, but not inside a UTF-8 character.
std::string_view Cut(std::string_view text) {
  text = text.substr(0, text.find('\n'));
  if (text.size() > RecentWarnings::kMostBytes) {
    size_t end = RecentWarnings::kMostBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) {
      --end;
    }
    text = text.substr(0, end);
  }
  return text;
}

}  // namespace

std::vector<RecentWarnings::Entry> RecentWarnings::Entries() {
  const std::lock_guard lock(mutex_);
  return {entries_.begin(), entries_.end()};
}

std::shared_ptr<RecentWarnings> RecentWarnings::Of(Log& log) {
  for (const spdlog::sink_ptr& known : log.logger().sinks()) {
    if (auto sink = std::dynamic_pointer_cast<RecentWarnings>(known)) {
      return sink;
    }
  }
  auto sink = std::make_shared<RecentWarnings>();
  sink->set_level(spdlog::level::warn);
  log.logger().sinks().push_back(sink);
  return sink;
}

void RecentWarnings::sink_it_(const spdlog::details::log_msg& message) {
  const std::string_view text = Cut({message.payload.data(), message.payload.size()});
  const auto now = std::chrono::steady_clock::now();
  if (!entries_.empty() && entries_.back().text == text) {
    entries_.back().time = now;
    ++entries_.back().times;
    return;
  }
  if (entries_.size() == kMostEntries) {
    entries_.pop_front();
  }
  entries_.push_back({std::string(text), message.level >= spdlog::level::err, now});
}

}  // namespace lararium::player
