#pragma once

// Values that stand written out in a Lua text: numbers, texts, true, false, and tables of
// these. Read without running it.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/drama/lua_tokens.h"

namespace lararium::drama {

// One entry of a table. Offsets are bytes of the text.
struct LuaEntry {
  std::string key;   // empty: counted
  size_t begin = 0;  // of the whole entry
  size_t value_begin = 0;
  size_t value_end = 0;
  size_t separator = 0;  // where its comma is; 0: none
  Json value;            // null: not kept, or a table where they are not wanted
};

// Reads one value after another. What returns false has a problem().
class LuaLiterals {
 public:
  static constexpr int kMaxDepth = 16;  // of tables in tables

  struct Problem {
    size_t offset = 0;  // bytes of the text
    std::string text;
  };

  // Borrows the text.
  LuaLiterals(std::string_view text, size_t offset) : tokens_(text, offset), text_(text) { Step(); }

  const LuaToken& token() const { return token_; }
  const Problem& problem() const { return problem_; }

  // The problem at a token: the token's own, if it has one.
  bool Fail(const LuaToken& token, std::string problem);

  // A value; steps behind it. depth: of the tables around it. end: behind its last byte.
  bool Value(int depth, Json& value, size_t& end);

  // Calls visit(entry) for each entry of the table that begins here, after its key was
  // read and before its value: visit reads that, by Value() or itself, and says whether
  // all was well.
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

// The entries of the table at an offset, with their separators; those before the first
// that cannot be read.
std::vector<LuaEntry> EntriesOf(std::string_view text, size_t offset, bool with_values);

}  // namespace lararium::drama
