#pragma once

// Reads literals from Lua source without running it: numbers, texts, true, false, and tables of
// these.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/drama/lua_tokens.h"

namespace lararium::drama {

// One entry of a table. Offsets are in bytes of the text.
struct LuaEntry {
  std::string key;   // Empty: an array entry.
  size_t begin = 0;  // Begin of the whole entry.
  size_t value_begin = 0;
  size_t value_end = 0;
  size_t separator = 0;  // Offset of its comma; 0: none.
  Json value;            // Null if values were not requested.
};

// Reads values in sequence. When a function returns false, problem() says why.
class LuaLiterals {
 public:
  static constexpr int kMaxDepth = 16;  // Maximum nesting of tables.

  struct Problem {
    size_t offset = 0;  // Bytes.
    std::string text;
  };

  // Borrows the text.
  LuaLiterals(std::string_view text, size_t offset) : tokens_(text, offset), text_(text) { Step(); }

  const LuaToken& token() const { return token_; }
  const Problem& problem() const { return problem_; }

  // Sets the problem at a token and returns false. The token's own problem takes precedence.
  bool Fail(const LuaToken& token, std::string problem);

  // Reads a value and moves past it. `depth` is the number of enclosing tables; `end` is set to the
  // offset after its last byte.
  bool Value(int depth, Json& value, size_t& end);

  // Calls visit(entry) for each entry of the table that begins here, after the key was read. visit
  // must read the value, with Value() or otherwise, and return whether that succeeded.
  template <typename Visit>
  bool Entries(size_t& end, Visit visit) {
    const LuaToken open = token_;
    Step();
    while (!token_.Is('}')) {
      LuaEntry entry;
      if (!Key(entry) || !visit(entry) || !Separator(open)) {
        return false;
      }
    }
    end = token_.end;
    Step();
    return true;
  }

 private:
  void Step() { token_ = tokens_.Next(); }
  std::string_view Text(const LuaToken& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }
  bool Key(LuaEntry& entry);
  bool Separator(const LuaToken& open);
  bool Table(int depth, Json& value, size_t& end);

  LuaTokens tokens_;
  std::string_view text_;
  LuaToken token_;
  Problem problem_;
};

// Entries of the table at an offset, with their separators, up to the first entry that cannot be
// read.
std::vector<LuaEntry> EntriesOf(std::string_view text, size_t offset, bool with_values);

}  // namespace lararium::drama
