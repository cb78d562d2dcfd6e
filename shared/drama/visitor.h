#pragma once

// What a drama knows of its visitor: where the camera is and looks, which keys were
// pressed, which messages came from elsewhere, what time it is where they stand. It may be
// recorded and played again.

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::drama {

struct Visitor {
  bool tracked = false;                  // else position and direction are those last known
  glm::vec3 position = glm::vec3(0.0f);  // of the eyes; stage, metres
  glm::vec3 direction = glm::vec3(0.0f, 0.0f, -1.0f);  // in which they look; unit length
  float hour = -1.0f;                                  // of the day, 0..24; below 0: unknown
  // Pressed since the tick before: names with a blank between. Among them are messages of
  // other programs (OSC), which begin with '/'.
  std::string keys = {};

  friend bool operator==(const Visitor&, const Visitor&) = default;
};

// Of the keys of one tick; more are not heard.
inline constexpr size_t kMaxKeyBytes = 16384;

// Adds a word to keys, unless there are too many.
void AddKey(std::string_view word, std::string& keys);
// Takes the first word off keys; "" where there is none.
std::string_view TakeKey(std::string_view& keys);

// A message as a word: its address, and each argument behind a comma: a number, T, F or N
// (true, false, nothing), or an apostrophe and a text in which everything but letters, digits
// and "_.-" is written as %HEX. "/door/open,1,'oak" is the address /door/open with 1 and "oak".
struct Message {
  std::string_view address;
  std::string_view arguments;  // from the first comma on; may be empty
};
// None: a key, or not a message's word.
std::optional<Message> ParseMessage(std::string_view word);
// A text as an argument, and back; nothing where it is not one.
std::string MessageText(std::string_view text);
std::optional<std::string> ReadMessageText(std::string_view argument);

// The visitor of each tick, from 0 on: an entry holds until the next one, but for its
// keys.
class VisitorLog {
 public:
  struct Entry {
    int64_t tick = 0;
    Visitor visitor;
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  // Lines "tick tracked x y z dx dy dz hour keys...", ticks ascending. place: what
  // errors call the text; they name the line.
  static Result<VisitorLog> Read(std::string_view text, std::string_view place);
  static Result<VisitorLog> Load(const std::filesystem::path& path);
  std::string Write() const;

  // From a tick on, which is not before that of the last entry. What is equal to what
  // holds anyhow is not kept.
  void Set(int64_t tick, const Visitor& visitor);
  Visitor At(int64_t tick) const;
  // Forgets what is later than a tick.
  void Truncate(int64_t tick);
  std::span<const Entry> entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace lararium::drama
