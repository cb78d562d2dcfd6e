#include "shared/drama/visitor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <type_traits>

#include "shared/core/file.h"
#include "shared/core/number_text.h"
#include "shared/core/plain_text.h"

namespace lararium::drama {
namespace {

constexpr std::string_view kHeader = "lararium visitor 1\n";
constexpr size_t kMaxEntries = 10'000'000;
constexpr int64_t kMaxTick = int64_t{24} * 3600 * 120;

// Reads the words of a line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  template <typename T>
  bool Number(T& value) {
    Skip();
    if constexpr (std::is_integral_v<T>) {
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
      if (error != std::errc()) {
        return false;
      }
      rest_.remove_prefix(static_cast<size_t>(end - rest_.data()));
    } else if (!TakeNumber(rest_, value)) {
      return false;
    }
    return rest_.empty() || rest_.front() == ' ';
  }
  std::string_view Rest() {
    Skip();
    return rest_;
  }

 private:
  void Skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }
  std::string_view rest_;
};

bool IsPlausible(const Visitor& visitor) {
  const auto near = [](const glm::vec3& v, float limit) {
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
  };
  return near(visitor.position, 1e5f) && near(visitor.direction, 1.01f) &&
         glm::length(visitor.direction) > 0.9f && visitor.hour >= -1.0f && visitor.hour <= 24.0f;
}

bool ParseLine(std::string_view line, VisitorLog::Entry& entry) {
  Words words(line);
  int tracked = 0;
  Visitor& visitor = entry.visitor;
  bool read = words.Number(entry.tick) && words.Number(tracked);
  for (float* value :
       {&visitor.position.x, &visitor.position.y, &visitor.position.z, &visitor.direction.x,
        &visitor.direction.y, &visitor.direction.z, &visitor.hour}) {
    read = read && words.Number(*value);
  }
  visitor.tracked = tracked == 1;
  visitor.keys = words.Rest();
  return read && (tracked == 0 || tracked == 1) && entry.tick >= 0 && entry.tick <= kMaxTick &&
         visitor.keys.size() <= kMaxKeyBytes && IsPlausible(visitor);
}

void AppendNumber(std::string& out, float value) { out += ' ' + FormatNumber(value); }

bool IsPlain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '.' || c == '-';
}

int HexDigit(char c) {
  return c >= '0' && c <= '9' ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

void AddKey(std::string_view word, std::string& keys) {
  if (!word.empty() && keys.size() + 1 + word.size() <= kMaxKeyBytes) {
    keys += keys.empty() ? "" : " ";
    keys += word;
  }
}

std::string_view TakeKey(std::string_view& keys) {
  keys.remove_prefix(std::min(keys.find_first_not_of(' '), keys.size()));
  const std::string_view word = keys.substr(0, keys.find(' '));
  keys.remove_prefix(word.size());
  return word;
}

std::optional<Message> ParseMessage(std::string_view word) {
  if (!word.starts_with('/')) {
    return std::nullopt;
  }
  const size_t end = std::min(word.find(','), word.size());
  return Message{word.substr(0, end), word.substr(end)};
}

std::string MessageText(std::string_view text) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string argument = "'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (IsPlain(c)) {
      argument += c;
    } else {
      argument += '%';
      argument += kHex[byte >> 4];
      argument += kHex[byte & 15];
    }
  }
  return argument;
}

std::optional<std::string> ReadMessageText(std::string_view argument) {
  if (!argument.starts_with('\'')) {
    return std::nullopt;
  }
  std::string text;
  for (size_t at = 1; at < argument.size(); ++at) {
    if (argument[at] != '%') {
      text += argument[at];
      continue;
    }
    const int high = at + 2 < argument.size() ? HexDigit(argument[at + 1]) : -1;
    const int low = high >= 0 ? HexDigit(argument[at + 2]) : -1;
    if (low < 0) {
      return std::nullopt;
    }
    text += static_cast<char>(16 * high + low);
    at += 2;
  }
  return text;
}

Result<VisitorLog> VisitorLog::Read(std::string_view text, std::string_view where) {
  if (!text.starts_with(kHeader)) {
    return Status::Error(where, "is not a visitor log", "record one with --visitor-log");
  }
  VisitorLog log;
  text.remove_prefix(kHeader.size());
  for (size_t line = 2; !text.empty(); ++line) {
    const size_t end = std::min(text.find('\n'), text.size());
    Entry entry;
    if (!ParseLine(text.substr(0, end), entry) || log.entries_.size() >= kMaxEntries ||
        (!log.entries_.empty() && entry.tick <= log.entries_.back().tick)) {
      return Status::Error(std::string(where) + ":" + std::to_string(line),
                           "is not a valid line of a visitor log", "record it again");
    }
    log.entries_.push_back(std::move(entry));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return log;
}

Result<VisitorLog> VisitorLog::Load(const std::filesystem::path& path) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(path));
  return Read(PlainText(text), path.string());
}

std::string VisitorLog::Write() const {
  std::string out(kHeader);
  for (const Entry& entry : entries_) {
    const Visitor& visitor = entry.visitor;
    out += std::to_string(entry.tick) + (visitor.tracked ? " 1" : " 0");
    for (const float value :
         {visitor.position.x, visitor.position.y, visitor.position.z, visitor.direction.x,
          visitor.direction.y, visitor.direction.z, visitor.hour}) {
      AppendNumber(out, value);
    }
    out += (visitor.keys.empty() ? "" : " ") + visitor.keys + "\n";
  }
  return out;
}

void VisitorLog::Set(int64_t tick, const Visitor& visitor) {
  if (At(tick) == visitor) {
    return;
  }
  if (!entries_.empty() && entries_.back().tick == tick) {
    entries_.back().visitor = visitor;
  } else {
    entries_.push_back({tick, visitor});
  }
}

Visitor VisitorLog::At(int64_t tick) const {
  const auto next = std::upper_bound(entries_.begin(), entries_.end(), tick,
                                     [](int64_t t, const Entry& entry) { return t < entry.tick; });
  if (next == entries_.begin()) {
    return {};
  }
  Visitor visitor = (next - 1)->visitor;
  if ((next - 1)->tick != tick) {
    visitor.keys.clear();
  }
  return visitor;
}

void VisitorLog::Truncate(int64_t tick) {
  while (!entries_.empty() && entries_.back().tick > tick) {
    entries_.pop_back();
  }
}

}  // namespace lararium::drama
