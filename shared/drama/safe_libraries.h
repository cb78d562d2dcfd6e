#pragma once

// The parts of Lua's standard library that a script may use, as globals. Where
// Lua's own functions would let a script see addresses, break a limit or differ
// from run to run, ours stand in their place; otherwise they behave as the Lua
// 5.4 reference manual says.

#include <lua.hpp>
#include <string_view>

#include "shared/core/random.h"

namespace lararium::drama {

// assert error ipairs next pairs pcall select setmetatable tonumber tostring
// type, and the table coroutine. next and pairs go through numbers, then
// texts, then booleans, each in their order; other keys are an error.
void OpenSafeBase(lua_State* lua);
// The table string, without dump; also what s:method() finds.
void OpenSafeString(lua_State* lua);
// The tables table and utf8. sort is stable.
void OpenSafeTable(lua_State* lua);
// The table math, whose random draws from `random`, without randomseed.
void OpenSafeMath(lua_State* lua, Random& random);

// Pushes the text of a value as tostring() gives it: no addresses.
void PushTextOf(lua_State* lua, int index);

// How many values a function may return at once: every call that passes them on
// copies them.
inline constexpr int kMaxResults = 255;

// Wraps (WrapField) a function of Lua's that goes through the text in its first
// argument: pays for that, and bounds the results.
int CallOnText(lua_State* lua);

}  // namespace lararium::drama
