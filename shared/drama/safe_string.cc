// The table string for scripts.

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "shared/drama/limits.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/safe_libraries.h"
#include "shared/drama/text_pattern.h"

namespace lararium::drama {
namespace {

constexpr int64_t kStepsPerInstruction = 4;  // Steps of pattern matching.
// A pattern search that charges for its work.
class Search {
 public:
  Search(lua_State* lua, std::string_view subject, std::string_view pattern)
      : lua_(lua), subject_(subject), pattern_(Compiled(lua, pattern)) {}

  // Finds the first match at `begin` or later; if anchored, only at `begin`.
  bool Find(size_t begin, bool anchored) {
    for (size_t at = begin; at <= subject_.size(); ++at) {
      if (MatchAt(at)) {
        return true;
      }
      if (anchored) {
        break;
      }
    }
    return false;
  }

  bool MatchAt(size_t at) {
    constexpr int64_t kBatch = 1 << 14;
    if (steps_left_ <= 0) {
      steps_left_ = kBatch;
    }
    // Charges for a batch of steps in advance; a match that needs more gets a larger batch.
    for (int64_t batch = kBatch;; batch *= 4) {
      Charge(lua_, 1);
      const int64_t before = steps_left_;
      const std::optional<size_t> end = pattern_.MatchAt(subject_, at, steps_left_, captures_);
      Charge(lua_, (before - std::max<int64_t>(steps_left_, 0)) / kStepsPerInstruction);
      if (steps_left_ >= 0) {
        begin_ = at;
        end_ = end.value_or(0);
        return end.has_value();
      }
      steps_left_ = batch * 4;
    }
  }

  size_t begin() const { return begin_; }
  size_t end() const { return end_; }
  std::string_view whole() const { return subject_.substr(begin_, end_ - begin_); }
  size_t capture_count() const { return captures_.size(); }

  void PushCapture(size_t index) const {
    const TextCapture& capture = captures_[index];
    if (capture.is_position) {
      lua_pushinteger(lua_, static_cast<lua_Integer>(capture.begin) + 1);
    } else {
      PushText(lua_, subject_.substr(capture.begin, capture.end - capture.begin));
    }
  }
  // Pushes all captures, or the whole match if the pattern has none.
  int PushCaptures() const {
    if (captures_.empty()) {
      PushText(lua_, whole());
      return 1;
    }
    luaL_checkstack(lua_, static_cast<int>(captures_.size()), "too many captures");
    for (size_t i = 0; i < captures_.size(); ++i) {
      PushCapture(i);
    }
    return static_cast<int>(captures_.size());
  }

 private:
  static TextPattern Compiled(lua_State* lua, std::string_view pattern) {
    Charge(lua, static_cast<int64_t>(pattern.size()));
    Result<TextPattern> compiled = TextPattern::Compile(pattern);
    if (!compiled.ok()) {
      luaL_error(lua, "%s", compiled.message().c_str());
    }
    return *std::move(compiled);
  }

  lua_State* lua_;
  std::string_view subject_;
  TextPattern pattern_;
  std::vector<TextCapture> captures_;
  int64_t steps_left_ = 0;
  size_t begin_ = 0;
  size_t end_ = 0;
};

// Converts the optional argument `init` to an offset: it counts from 1, or from the end if
// negative. The offset may lie after the end.
size_t StartOffset(lua_State* lua, int argument, size_t size) {
  const lua_Integer init = luaL_optinteger(lua, argument, 1);
  const auto length = static_cast<lua_Integer>(size);
  if (init > 0) {
    return init > length + 1 ? size + 1 : static_cast<size_t>(init - 1);
  }
  return init == 0 || init < -length ? 0 : static_cast<size_t>(length + init);
}

bool TakeAnchor(std::string_view& pattern) {
  const bool anchored = pattern.starts_with('^');
  pattern.remove_prefix(anchored ? 1 : 0);
  return anchored;
}

int FindPlain(lua_State* lua, std::string_view subject, std::string_view text, size_t begin) {
  // In the worst case the search compares at every offset.
  Charge(lua, static_cast<int64_t>(subject.size() / kAllocatedBytesPerInstruction *
                                   (1 + text.size() / 8)));
  const size_t found = subject.find(text, begin);
  if (found == std::string_view::npos) {
    lua_pushnil(lua);
    return 1;
  }
  lua_pushinteger(lua, static_cast<lua_Integer>(found) + 1);
  lua_pushinteger(lua, static_cast<lua_Integer>(found + text.size()));
  return 2;
}

// string.find and string.match differ only in their results.
int FindOrMatch(lua_State* lua, bool find) {
  const std::string_view subject = CheckText(lua, 1);
  std::string_view pattern = CheckText(lua, 2);
  const size_t begin = StartOffset(lua, 3, subject.size());
  if (begin > subject.size()) {
    lua_pushnil(lua);
    return 1;
  }
  const bool has_magic = pattern.find_first_of("^$*+?.([%-") != std::string_view::npos;
  if (find && (lua_toboolean(lua, 4) != 0 || !has_magic)) {
    return FindPlain(lua, subject, pattern, begin);
  }
  const bool anchored = TakeAnchor(pattern);
  Search search(lua, subject, pattern);
  if (!search.Find(begin, anchored)) {
    lua_pushnil(lua);
    return 1;
  }
  if (!find) {
    return search.PushCaptures();
  }
  lua_pushinteger(lua, static_cast<lua_Integer>(search.begin()) + 1);
  lua_pushinteger(lua, static_cast<lua_Integer>(search.end()));
  return 2 + (search.capture_count() == 0 ? 0 : search.PushCaptures());
}

int Find(lua_State* lua) { return FindOrMatch(lua, true); }
int Match(lua_State* lua) { return FindOrMatch(lua, false); }

// Iterator of gmatch. Upvalues: subject, pattern, next offset, end of the last match (where no
// empty match is allowed).
int NextMatch(lua_State* lua) {
  const std::string_view subject = CheckText(lua, lua_upvalueindex(1));
  const std::string_view pattern = CheckText(lua, lua_upvalueindex(2));
  const auto last_end = static_cast<size_t>(lua_tointeger(lua, lua_upvalueindex(4)));
  Search search(lua, subject, pattern);
  auto begin = static_cast<size_t>(lua_tointeger(lua, lua_upvalueindex(3)));
  for (; search.Find(begin, false); begin = search.begin() + 1) {
    if (search.end() != last_end) {
      lua_pushinteger(lua, static_cast<lua_Integer>(search.end()));
      lua_copy(lua, -1, lua_upvalueindex(3));
      lua_replace(lua, lua_upvalueindex(4));
      return search.PushCaptures();
    }
  }
  return 0;
}

int MatchAll(lua_State* lua) {
  const size_t size = CheckText(lua, 1).size();
  CheckText(lua, 2);
  const size_t begin = std::min(StartOffset(lua, 3, size), size + 1);
  lua_settop(lua, 2);
  lua_pushinteger(lua, static_cast<lua_Integer>(begin));
  lua_pushinteger(lua, -1);
  lua_pushcclosure(lua, NextMatch, 4);
  return 1;
}

// Expands "%0" ... "%9" and "%%" of a replacement text.
void AppendReplacement(lua_State* lua,
                       const Search& search,
                       std::string_view replacement,
                       std::string& result) {
  for (size_t i = 0; i < replacement.size(); ++i) {
    if (replacement[i] != '%') {
      result += replacement[i];
      continue;
    }
    const char c = ++i < replacement.size() ? replacement[i] : '\0';
    const auto index = static_cast<size_t>(c - '1');
    if (c == '%') {
      result += '%';
    } else if (c == '0' || (c == '1' && search.capture_count() == 0)) {
      result += search.whole();
    } else if (c >= '1' && c <= '9' && index < search.capture_count()) {
      search.PushCapture(index);
      result += CheckText(lua, -1);
      lua_pop(lua, 1);
    } else {
      luaL_error(lua, "invalid use of '%%' in replacement string");
    }
  }
}

// Appends the replacement of a match for gsub: argument 3 is a text, a table or a function.
void AppendSubstitute(lua_State* lua, const Search& search, std::string& result) {
  if (lua_type(lua, 3) == LUA_TTABLE) {
    search.PushCaptures();
    lua_settop(lua, 5);  // The first capture is the key.
    lua_gettable(lua, 3);
  } else if (lua_type(lua, 3) == LUA_TFUNCTION) {
    lua_pushvalue(lua, 3);
    const int count = search.PushCaptures();
    lua_call(lua, count, 1);
  } else {
    AppendReplacement(lua, search, CheckText(lua, 3), result);
    return;
  }
  if (lua_toboolean(lua, -1) == 0) {
    result += search.whole();
  } else if (lua_isstring(lua, -1) != 0) {
    result += CheckText(lua, -1);
  } else {
    luaL_error(lua, "invalid replacement value (a %s)", luaL_typename(lua, -1));
  }
  lua_settop(lua, 4);
}

int Substitute(lua_State* lua) {
  const std::string_view subject = CheckText(lua, 1);
  std::string_view pattern = CheckText(lua, 2);
  const int type = lua_type(lua, 3);
  luaL_argexpected(
      lua,
      type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TTABLE || type == LUA_TFUNCTION, 3,
      "string/function/table");
  const lua_Integer max_count = luaL_optinteger(lua, 4, std::numeric_limits<lua_Integer>::max());
  lua_settop(lua, 4);
  const bool anchored = TakeAnchor(pattern);
  Search search(lua, subject, pattern);
  std::string result;
  lua_Integer count = 0;
  size_t at = 0;                             // Everything before it has been copied.
  size_t last_end = std::string_view::npos;  // No empty match is allowed here.
  while (count < max_count) {
    if (search.MatchAt(at) && search.end() != last_end) {
      ++count;
      AppendSubstitute(lua, search, result);
      at = last_end = search.end();
    } else if (at < subject.size()) {
      result += subject[at++];
    } else {
      break;
    }
    if (anchored || at > subject.size()) {
      break;
    }
    if (result.size() > Limits::kMaxText) {
      return luaL_error(lua, "the resulting text is too long");
    }
  }
  result += subject.substr(std::min(at, subject.size()));
  PushText(lua, result);
  lua_pushinteger(lua, count);
  return 2;
}

int Repeat(lua_State* lua) {
  const std::string_view text = CheckText(lua, 1);
  const lua_Integer count = luaL_checkinteger(lua, 2);
  size_t separator_size = 0;
  const char* separator = luaL_optlstring(lua, 3, "", &separator_size);
  const size_t unit = text.size() + separator_size;
  if (count > 0 && unit > 0 && static_cast<uint64_t>(count) > Limits::kMaxText / unit + 1) {
    return luaL_error(lua, "the resulting text is too long");
  }
  std::string result;
  for (lua_Integer i = 0; unit > 0 && i < count; ++i) {
    result += text;
    result.append(separator, i + 1 < count ? separator_size : 0);
  }
  Charge(lua, static_cast<int64_t>(result.size() / kAllocatedBytesPerInstruction));
  PushText(lua, result);
  return 1;
}

// The upvalue is Lua's format, which limits widths itself (two digits). It must not print
// addresses.
int Format(lua_State* lua) {
  const std::string_view format = CheckText(lua, 1);
  int argument = 1;
  for (size_t i = format.find('%'); i < format.size(); i = format.find('%', i + 1)) {
    i = format.find_first_not_of("-+ #0123456789.", i + 1);
    if (i == std::string_view::npos) {
      break;
    }
    if (format[i] == '%') {
      continue;
    }
    ++argument;
    if (format[i] == 'p') {
      return luaL_error(lua, "'%%p' is not available");
    }
    if (format[i] == 's' && argument <= lua_gettop(lua)) {
      PushTextOf(lua, argument);
      lua_replace(lua, argument);
    }
  }
  return CallWrapped(lua);
}

}  // namespace

int CallOnText(lua_State* lua) {
  if (lua_type(lua, 1) == LUA_TSTRING) {
    Charge(lua, static_cast<int64_t>(lua_rawlen(lua, 1) / kAllocatedBytesPerInstruction));
  }
  const int results = CallWrapped(lua);
  if (results > kMaxResults) {
    return luaL_error(lua, "more than %d results", kMaxResults);
  }
  return results;
}

void OpenSafeString(lua_State* lua) {
  constexpr luaL_Reg kOurs[] = {{"find", Find},   {"gmatch", MatchAll}, {"gsub", Substitute},
                                {"match", Match}, {"rep", Repeat},      {nullptr, nullptr}};
  luaL_requiref(lua, LUA_STRLIBNAME, luaopen_string, 1);
  lua_pushnil(lua);
  lua_setfield(lua, -2, "dump");
  for (const char* name : {"byte", "lower", "pack", "reverse", "unpack", "upper"}) {
    WrapField(lua, name, CallOnText);
  }
  WrapField(lua, "format", Format);
  luaL_setfuncs(lua, kOurs, 0);

  // Metatable of all texts: methods, but no arithmetic with texts of digits.
  lua_pushliteral(lua, "");
  lua_createtable(lua, 0, 2);
  lua_pushvalue(lua, -3);
  lua_setfield(lua, -2, "__index");
  lua_pushboolean(lua, 0);
  lua_setfield(lua, -2, "__metatable");
  lua_setmetatable(lua, -2);
  lua_pop(lua, 2);
}

}  // namespace lararium::drama
