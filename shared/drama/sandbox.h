#pragma once

// A Lua state that holds nothing a script could do harm with: the libraries of
// safe_libraries.h, within limits.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "shared/core/random.h"
#include "shared/core/status.h"
#include "shared/drama/limits.h"

struct lua_State;

namespace lararium::drama {

// What is known of an error that ended a coroutine.
struct LuaError {
  std::string message;  // with file and line
  std::string traceback;
};

// "drama.lua:12" of the innermost function that is not one of lua/std, or "".
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

  // Compiles source text and leaves its function on the stack of lua(). Errors
  // carry place and line. Binary chunks are refused.
  Status Compile(std::string_view text, const std::string& place);

  // Of a coroutine that lua_resume() ended with an error. started_at: what to blame where
  // none of the script's functions runs in it.
  LuaError Describe(lua_State* coroutine, const std::string& started_at);

 private:
  Sandbox(size_t memory_limit, int64_t instruction_limit, uint64_t seed)
      : limits_(memory_limit, instruction_limit), random_(seed) {}

  Limits limits_;
  Random random_;
  lua_State* lua_ = nullptr;
};

}  // namespace lararium::drama
