#pragma once

// What our functions for Lua share. Lua is built for C++ here: lua_error()
// throws and is caught by lua_pcall() and lua_resume(), so that destructors run.

#include <cstdint>
#include <lua.hpp>
#include <string_view>

#include "shared/core/ease.h"
#include "shared/drama/limits.h"

namespace lararium::drama {

// Every state carries its limits in the space that Lua keeps for its host.
inline Limits& LimitsOf(lua_State* lua) { return **static_cast<Limits**>(lua_getextraspace(lua)); }

// Ends the running function with an error when a limit was passed.
inline void RaiseIfTripped(lua_State* lua) {
  if (LimitsOf(lua).tripped()) {
    lua_pushliteral(lua, "a limit was passed");  // the host reports Limits::Reason()
    lua_error(lua);
  }
}

// Counts work that is done in C++ as if it were instructions of the script.
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

// A number that is finite; `what` is called so in the error.
inline double CheckFinite(lua_State* lua, int argument, const char* what) {
  const double value = luaL_checknumber(lua, argument);
  if (!(value - value == 0.0)) {
    luaL_error(lua, "%s must be a finite number", what);
  }
  return value;
}

// The ease of a name.
inline Ease CheckEase(lua_State* lua, std::string_view name) {
  const std::optional<Ease> ease = EaseNamed(name);
  if (!ease) {
    luaL_error(lua, "ease is linear, in, out or smooth");
  }
  return ease.value_or(Ease::kLinear);
}

// Puts function in the place of field `name` of the table on top of the stack.
// Its upvalue is what was there before.
inline void WrapField(lua_State* lua, const char* name, lua_CFunction function) {
  lua_getfield(lua, -1, name);
  lua_pushcclosure(lua, function, 1);
  lua_setfield(lua, -2, name);
}

// In such a function: calls what it wraps with the same arguments.
inline int CallWrapped(lua_State* lua) { return lua_tocfunction(lua, lua_upvalueindex(1))(lua); }

// Calls body(lua) so that a Lua error ends it and is then dropped. For what the
// host does outside of any script. False when there was an error.
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
