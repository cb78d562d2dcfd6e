#pragma once

// A Lua state for untrusted scripts: only the libraries of safe_libraries.h, within limits.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "shared/core/random.h"
#include "shared/core/status.h"
#include "shared/drama/limits.h"

struct lua_State;

namespace lararium::drama {

// An error that ended a coroutine.
struct LuaError {
  std::string message;  // Includes file and line.
  std::string traceback;
};

// File and line ("drama.lua:12") of the innermost function outside lua/std, or "".
std::string PlaceOf(lua_State* coroutine);

class Sandbox {
 public:
  static Result<std::unique_ptr<Sandbox>> Create(size_t memory_limit,
                                                 int64_t instruction_limit,
                                                 uint64_t seed);
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  // The main thread. Scripts run in coroutines of it.
  lua_State* lua() { return lua_; }
  Limits& limits() { return limits_; }

  // Compiles source text and leaves its function on the stack of lua(). Errors name `where` and the
  // line. Refuses binary chunks.
  Status Compile(std::string_view text, const std::string& where);

  // Describes the error of a coroutine after lua_resume(). `started_at` is the location to report
  // if no function of the script is on its stack.
  LuaError Describe(lua_State* coroutine, const std::string& started_at);

 private:
  Sandbox(size_t memory_limit, int64_t instruction_limit, uint64_t seed)
      : limits_(memory_limit, instruction_limit), random_(seed) {}

  Limits limits_;
  Random random_;
  lua_State* lua_ = nullptr;
};

}  // namespace lararium::drama
