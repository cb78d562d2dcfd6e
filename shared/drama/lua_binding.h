#pragma once

// Helpers for C++ functions that Lua calls. Lua is compiled as C++: lua_error() throws, and
// lua_pcall() and lua_resume() catch, so destructors run.

#include <cstdint>
#include <string_view>

#include "shared/core/ease.h"
#include "shared/drama/limits.h"
#include "shared/drama/lua_api.h"

namespace lararium::drama {

// The limits of a state; its extra space holds a pointer to them.
inline Limits& LimitsOf(lua_State* lua) { return **static_cast<Limits**>(lua_getextraspace(lua)); }

// Raises a Lua error if a limit was exceeded.
inline void RaiseIfTripped(lua_State* lua) {
  if (LimitsOf(lua).tripped()) {
    lua_pushliteral(lua, "a limit was passed");  // The host reports Limits::Reason().
    lua_error(lua);
  }
}

// Charges work in C++ as instructions of the script.
inline void Charge(lua_State* lua, int64_t instructions) {
  LimitsOf(lua).Charge(instructions);
  RaiseIfTripped(lua);
}

inline std::string_view CheckText(lua_State* lua, int argument) {
  size_t size = 0;
  const char* text = luaL_checklstring(lua, argument, &size);
  return {text, size};
}

inline void PushText(lua_State* lua, std::string_view text) {
  lua_pushlstring(lua, text.data(), text.size());
}

// Reads a finite number; an error calls it `what`.
inline double CheckFinite(lua_State* lua, int argument, const char* what) {
  const double value = luaL_checknumber(lua, argument);
  if (!(value - value == 0.0)) {
    luaL_error(lua, "%s must be a finite number", what);
  }
  return value;
}

// Returns the ease of a name.
inline Ease CheckEase(lua_State* lua, std::string_view name) {
  const std::optional<Ease> ease = EaseNamed(name);
  if (!ease) {
    luaL_error(lua, "ease is linear, in, out or smooth");
  }
  return ease.value_or(Ease::kLinear);
}

// Replaces the field `name` of the table on top of the stack by `function`, whose upvalue is the
// old value.
inline void WrapField(lua_State* lua, const char* name, lua_CFunction function) {
  lua_getfield(lua, -1, name);
  lua_pushcclosure(lua, function, 1);
  lua_setfield(lua, -2, name);
}

// Calls the wrapped function with the same arguments. Only for functions of WrapField().
inline int CallWrapped(lua_State* lua) { return lua_tocfunction(lua, lua_upvalueindex(1))(lua); }

// Calls body(lua) in protected mode, for work of the host outside of any script. Returns false and
// drops the error if there was one.
template <typename Body>
bool Protected(lua_State* lua, Body body) {
  lua_pushcfunction(lua, [](lua_State* inner) {
    (*static_cast<Body*>(lua_touserdata(inner, 1)))(inner);
    return 0;
  });
  lua_pushlightuserdata(lua, &body);
  const bool ok = lua_pcall(lua, 1, 0, 0) == LUA_OK;
  if (!ok) {
    lua_pop(lua, 1);
  }
  return ok;
}

}  // namespace lararium::drama
