#pragma once

// Lua's text patterns (Lua 5.4 reference manual, 6.4.1) with a limit on their work: Lua's own
// matcher can run for years inside one instruction. Character classes are ASCII.

#include <bitset>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::drama {

// A part of the subject. For a position capture "()", only `begin` is meaningful.
struct TextCapture {
  size_t begin = 0;
  size_t end = 0;
  bool is_position = false;
};

class TextPattern {
 public:
  static constexpr size_t kMaxCaptures = 32;

  // Errors describe the problem of the pattern, without file and line.
  static Result<TextPattern> Compile(std::string_view pattern);

  // Returns the end of the match that begins at `begin`, if there is one, and its captures. Each
  // inspected character decrements steps_left; the search gives up when it becomes negative.
  std::optional<size_t> MatchAt(std::string_view subject,
                                size_t begin,
                                int64_t& steps_left,
                                std::vector<TextCapture>& captures) const;

  size_t capture_count() const { return capture_count_; }

 private:
  enum class Kind { kSet, kOpen, kPosition, kClose, kBalance, kFrontier, kRepeatCapture, kEnd };
  enum class Repeat { kOnce, kOptional, kMost, kFewest };  // No suffix, ?, *, -.

  struct Item {
    Kind kind = Kind::kSet;
    Repeat repeat = Repeat::kOnce;
    std::bitset<256> set;  // kSet, kFrontier
    size_t capture = 0;    // kOpen, kPosition, kClose, kRepeatCapture
    uint8_t open = 0;      // kBalance
    uint8_t close = 0;
  };
  class Compiler;
  class Run;

  std::vector<Item> items_;
  size_t capture_count_ = 0;
};

}  // namespace lararium::drama
