#pragma once

// The parts of Lua's standard library that a script may use, as globals. Functions that would show
// addresses, break a limit or differ between runs are replaced by our own; the rest behaves as in
// the Lua 5.4 reference manual.

#include "shared/core/random.h"
#include "shared/drama/lua_api.h"

namespace lararium::drama {

// assert error ipairs next pairs pcall select setmetatable tonumber tostring type, and the table
// coroutine. next and pairs visit numbers, then texts, then booleans, each in ascending order;
// other keys are an error.
void OpenSafeBase(lua_State* lua);
// The table string without dump, which is also the source of s:method().
void OpenSafeString(lua_State* lua);
// The tables `table` and `utf8`. table.sort is stable.
void OpenSafeTable(lua_State* lua);
// The table math without randomseed; math.random draws from `random`.
void OpenSafeMath(lua_State* lua, Random& random);

// Pushes the text of a value like tostring(), but without addresses.
void PushTextOf(lua_State* lua, int index);

// Limit of the values that a function returns, because every call that passes them on copies them.
inline constexpr int kMaxResults = 255;

// Wrapper (WrapField) for a Lua function that scans the text in its first argument: charges for the
// text and limits the number of results.
int CallOnText(lua_State* lua);

}  // namespace lararium::drama
