#include "shared/drama/sandbox.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <utility>

#include "shared/core/plain_text.h"
#include "shared/core/utf8.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/safe_libraries.h"

namespace lararium::drama {
namespace {

void CountInstructions(lua_State* lua, lua_Debug* /*activation*/) {
  LimitsOf(lua).Charge(lua_gethookcount(lua));
  if (LimitsOf(lua).tripped()) {
    // From now on the hook runs at each instruction, so close handlers of this coroutine are
    // counted.
    lua_sethook(lua, CountInstructions, LUA_MASKCOUNT, 1);
    RaiseIfTripped(lua);
  }
}

// PlaceOf(coroutine), or started_at if it is empty, followed by ": ".
std::string Where(lua_State* coroutine, const std::string& started_at) {
  const std::string place = PlaceOf(coroutine);
  return place.empty() && started_at.empty() ? "" : (place.empty() ? started_at : place) + ": ";
}

// The message on top of a coroutine's stack. Errors of lua/std get the line of the script that
// called it.
std::string TopAsText(lua_State* coroutine, const std::string& started_at) {
  if (lua_type(coroutine, -1) == LUA_TSTRING) {
    const std::string text = lua_tostring(coroutine, -1);
    if (text == "attempt to yield across a C-call boundary") {
      return Where(coroutine, started_at) + text;  // Lua gives this one no position.
    }
    const size_t position_end = text.starts_with("std/") ? text.find(": ") : std::string::npos;
    return position_end == std::string::npos
               ? text
               : Where(coroutine, started_at) + text.substr(position_end + 2);
  }
  return Where(coroutine, started_at) + "error object is a " + luaL_typename(coroutine, -1);
}

}  // namespace

std::string PlaceOf(lua_State* coroutine) {
  lua_Debug activation;
  for (int level = 0; lua_getstack(coroutine, level, &activation) != 0; ++level) {
    lua_getinfo(coroutine, "Sl", &activation);
    const bool is_std = std::string_view(activation.source).starts_with("@std/");
    if (activation.currentline > 0 && !is_std) {
      return std::string(activation.short_src) + ":" + std::to_string(activation.currentline);
    }
  }
  return "";
}

Result<std::unique_ptr<Sandbox>> Sandbox::Create(size_t memory_limit,
                                                 int64_t instruction_limit,
                                                 uint64_t seed) {
  std::unique_ptr<Sandbox> sandbox(new Sandbox(memory_limit, instruction_limit, seed));
  lua_State* lua = lua_newstate(Limits::Allocate, &sandbox->limits_);
  sandbox->lua_ = lua;
  bool opened = false;
  if (lua != nullptr) {
    *static_cast<Limits**>(lua_getextraspace(lua)) = &sandbox->limits_;
    lua_sethook(lua, CountInstructions, LUA_MASKCOUNT, Limits::kHookInterval);
    opened = Protected(lua, [&](lua_State* inner) {
      OpenSafeBase(inner);
      OpenSafeString(inner);
      OpenSafeTable(inner);
      OpenSafeMath(inner, sandbox->random_);
    });
  }
  if (!opened) {
    return Status::Error("drama", "the limits are too low to start a script", "raise them");
  }
  sandbox->limits_.Refill();
  return sandbox;
}

Sandbox::~Sandbox() {
  if (lua_ != nullptr) {
    lua_close(lua_);
  }
}

namespace {

// What the line that Lua complains about holds instead of signs of Lua: word processors and web
// pages put other blanks, quotes and dashes into scripts. Empty if there is none.
std::string OddSign(std::string_view text, const std::string& problem) {
  constexpr std::pair<uint32_t, std::string_view> kSigns[] = {{0xA0, "no-break space"},
                                                              {0x202F, "narrow no-break space"},
                                                              {0x3000, "ideographic space"},
                                                              {0x200B, "zero width space"},
                                                              {0x200E, "left-to-right mark"},
                                                              {0x200F, "right-to-left mark"},
                                                              {0xFEFF, "byte order mark"},
                                                              {0x2018, "quotation mark"},
                                                              {0x2019, "quotation mark"},
                                                              {0x201C, "quotation mark"},
                                                              {0x201D, "quotation mark"},
                                                              {0x201E, "quotation mark"},
                                                              {0xAB, "quotation mark"},
                                                              {0xBB, "quotation mark"},
                                                              {0x2010, "hyphen"},
                                                              {0x2013, "dash"},
                                                              {0x2014, "dash"},
                                                              {0x2212, "minus sign"},
                                                              {0x2026, "three dots as one"}};
  // "file.lua:3: unexpected symbol". A name of a file may hold colons too.
  const size_t end = problem.find(": ");
  const size_t colon = end == std::string::npos ? end : problem.rfind(':', end - 1);
  int line = 0;
  if (colon == std::string::npos ||
      std::from_chars(problem.data() + colon + 1, problem.data() + end, line).ec != std::errc()) {
    return "";
  }
  for (; line > 1 && text.find('\n') != std::string_view::npos; --line) {
    text.remove_prefix(text.find('\n') + 1);
  }
  text = text.substr(0, text.find('\n'));
  for (size_t at = 0; at < text.size();) {
    const uint32_t character = NextCharacter(text, at);
    for (const auto& [sign, name] : kSigns) {
      if (sign == character) {
        char code[16];
        std::snprintf(code, sizeof(code), "U+%04X", sign);
        return std::string("; the line holds a ") + std::string(name) + " (" + code +
               "), which Lua does not know: type it again in a plain text editor";
      }
    }
  }
  return "";
}

}  // namespace

Status Sandbox::Compile(std::string_view text, const std::string& where) {
  const size_t zero = text.find('\0');
  const auto at_line = [&](size_t offset) {
    return where + ":" +
           std::to_string(
               1 + std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(offset), '\n'));
  };
  if (zero != std::string_view::npos) {
    return Status::Error(at_line(zero), "holds a zero byte, so it is not UTF-8",
                         "save the script as UTF-8");
  }
  if (text.starts_with('\x1B')) {
    return Status::Error(at_line(0), "is compiled Lua, which could do harm",
                         "give the script as text");
  }
  text = WithoutByteOrderMark(text);
  const std::string chunk_name = "@" + where;
  const int status = luaL_loadbufferx(lua_, text.data(), text.size(), chunk_name.c_str(), "t");
  if (status == LUA_OK) {
    return Status();
  }
  limits_.TripIfRefused();
  const std::string problem = limits_.tripped() ? limits_.Reason() : lua_tostring(lua_, -1);
  lua_pop(lua_, 1);
  // Lua's messages begin with a shortened file name and ":line: ".
  return limits_.tripped()
             ? Status::Error(where, problem)
             : Status::Error("drama", problem + OddSign(text, problem), "correct the script");
}

LuaError Sandbox::Describe(lua_State* coroutine, const std::string& started_at) {
  limits_.TripIfRefused();
  LuaError error;
  error.message = limits_.tripped() ? Where(coroutine, started_at) + limits_.Reason()
                                    : TopAsText(coroutine, started_at);
  Protected(lua_, [&](lua_State* lua) {
    luaL_traceback(lua, coroutine, nullptr, 0);
    error.traceback = lua_tostring(lua, -1);
  });
  return error;
}

}  // namespace lararium::drama
