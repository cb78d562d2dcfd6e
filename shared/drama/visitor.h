#pragma once

// The input of a drama from its visitor: pose of the camera, keys, messages of other programs,
// local time of day. It can be recorded and replayed.

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::drama {

// One of several visitors who watch the same drama, each on a device of their own.
struct GroupVisitor {
  int number = 0;        // Order in which they joined.
  bool tracked = false;  // Position and direction: see Visitor.
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 direction = glm::vec3(0.0f, 0.0f, -1.0f);

  friend bool operator==(const GroupVisitor&, const GroupVisitor&) = default;
};

struct Visitor {
  bool tracked = false;                  // False: position and direction are the last known ones.
  glm::vec3 position = glm::vec3(0.0f);  // Eyes, stage frame, metres.
  glm::vec3 direction = glm::vec3(0.0f, 0.0f, -1.0f);  // Viewing direction, unit length.
  float hour = -1.0f;                                  // Time of day, 0..24; negative: unknown.
  // Names of the keys pressed since the tick before, separated by blanks. Messages of other
  // programs (OSC) are among them and begin with '/'.
  std::string keys = {};
  // All visitors, by number, if there are several: then they count instead of the pose above. Null:
  // there is one. A visitor log that is written to a file has no groups.
  std::shared_ptr<const std::vector<GroupVisitor>> group = nullptr;

  friend bool operator==(const Visitor&, const Visitor&) = default;
};

// Calls visit(GroupVisitor) for each visitor whose camera is tracked.
template <typename Visit>
void ForEachTracked(const Visitor& visitor, const Visit& visit) {
  if (visitor.group == nullptr && visitor.tracked) {
    visit(GroupVisitor{0, true, visitor.position, visitor.direction});
  } else if (visitor.group != nullptr) {
    for (const GroupVisitor& one : *visitor.group) {
      if (one.tracked) {
        visit(one);
      }
    }
  }
}

// Limit of the keys of one tick; further keys are ignored.
inline constexpr size_t kMaxKeyBytes = 16384;

// Adds a word to `keys` unless the limit would be exceeded.
void AddKey(std::string_view word, std::string& keys);
// Removes the first word of `keys` and returns it; "" if there is none.
std::string_view TakeKey(std::string_view& keys);

// A message encoded as one word: its address and, after a comma each, its arguments. An argument is
// a number, T, F or N (true, false, nil), or an apostrophe followed by a text in which everything
// but letters, digits and "_.-" is written as %HEX. Example: "/door/open,1,'oak" is the address
// /door/open with the arguments 1 and "oak".
struct Message {
  std::string_view address;
  std::string_view arguments;  // Starts with the first comma; may be empty.
};
// None: the word is a key or not a valid message.
std::optional<Message> ParseMessage(std::string_view word);
// Encode and decode a text argument; none: it is not a text.
std::string MessageText(std::string_view text);
std::optional<std::string> ReadMessageText(std::string_view argument);

// The visitor of each tick from 0 on. An entry is valid until the next one, except for its keys.
class VisitorLog {
 public:
  struct Entry {
    int64_t tick = 0;
    Visitor visitor;
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  // Reads lines "tick tracked x y z dx dy dz hour keys..." with ascending ticks. Errors name
  // `where` and the line.
  static Result<VisitorLog> Read(std::string_view text, std::string_view where);
  static Result<VisitorLog> Load(const std::filesystem::path& path);
  std::string Write() const;

  // Sets the visitor from a tick on, which must not be before the last entry. A value equal to the
  // present one is not stored.
  void Set(int64_t tick, const Visitor& visitor);
  Visitor At(int64_t tick) const;
  // Removes entries after a tick.
  void Truncate(int64_t tick);
  std::span<const Entry> entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace lararium::drama
