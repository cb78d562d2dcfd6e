#pragma once

// The words of a Lua 5.4 text (reference manual, section 3.1): for reading and editing
// scripts without running them. Comments and blanks lie between tokens.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lararium::drama {

struct LuaToken {
  enum class Kind { kEnd, kName, kNumber, kText, kSymbol, kBad };
  Kind kind = Kind::kEnd;
  size_t begin = 0;  // bytes of the text
  size_t end = 0;
  char symbol = 0;                // of kSymbol: its first character
  const char* problem = nullptr;  // of kBad

  bool Is(char c) const { return kind == Kind::kSymbol && symbol == c && end == begin + 1; }
};

// Goes through a text from an offset on. Borrows the text.
class LuaTokens {
 public:
  explicit LuaTokens(std::string_view text, size_t offset = 0) : text_(text), next_(offset) {}

  LuaToken Next();
  size_t offset() const { return next_; }

 private:
  bool SkipBlanks(LuaToken& bad);
  bool SkipLong(size_t begin);
  LuaToken LongText(size_t begin);
  LuaToken QuotedText(size_t begin);
  LuaToken Number(size_t begin);

  std::string_view text_;
  size_t next_;
};

// What the token says. None: a number beyond all doubles, an escape that Lua does not know.
std::optional<double> NumberOf(std::string_view token);
std::optional<std::string> TextOf(std::string_view token);

// Line and column, from 1; columns count bytes.
struct LuaPosition {
  size_t line = 1;
  size_t column = 1;
};
LuaPosition PositionOf(std::string_view text, size_t offset);

}  // namespace lararium::drama
