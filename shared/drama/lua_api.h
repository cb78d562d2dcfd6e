#pragma once

// Lua's functions. Debian's build of Lua for C++ exports the names of C in release 12, and those of
// C++ in release 13 (see cmake/dependencies.cmake).

#ifdef LARARIUM_LUA_NAMES_OF_CXX
#include <lauxlib.h>
#include <lua.h>
#include <lualib.h>
#else
#include <lua.hpp>
#endif
