#pragma once

// Tokenizer of Lua 5.4 (reference manual, section 3.1), for reading and editing scripts without
// running them. Comments and whitespace are skipped.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "shared/core/plain_text.h"

namespace lararium::drama {

struct LuaToken {
  enum class Kind { kEnd, kName, kNumber, kText, kSymbol, kBad };
  Kind kind = Kind::kEnd;
  size_t begin = 0;  // Offsets in bytes.
  size_t end = 0;
  char symbol = 0;                // kSymbol: its first character.
  const char* problem = nullptr;  // kBad: why.

  bool Is(char c) const { return kind == Kind::kSymbol && symbol == c && end == begin + 1; }
};

// Iterates over the tokens of a text from an offset on. Borrows the text.
class LuaTokens {
 public:
  explicit LuaTokens(std::string_view text, size_t offset = 0)
      : text_(text), next_(offset > 0 ? offset : text.size() - WithoutByteOrderMark(text).size()) {}

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

// Values of a number token and a text token. None: the number exceeds the range of double, or the
// text has an escape that Lua does not know.
std::optional<double> NumberOf(std::string_view token);
std::optional<std::string> TextOf(std::string_view token);

// Line and column, both from 1; columns are in bytes.
struct LuaPosition {
  size_t line = 1;
  size_t column = 1;
};
LuaPosition PositionOf(std::string_view text, size_t offset);

}  // namespace lararium::drama
