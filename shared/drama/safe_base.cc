// The base library, coroutines and mathematics for scripts.

#include <algorithm>
#include <string_view>
#include <vector>

#include "shared/drama/lua_binding.h"
#include "shared/drama/safe_libraries.h"

namespace lararium::drama {
namespace {

// ---- protected calls: they catch errors, but not tripped limits -------------

// Unwinding an error from deeply nested calls takes about as long as this many instructions.
constexpr int64_t kErrorCost = 10'000;

// After a failed call: raises the error again if a limit was exceeded.
void LetLimitsThrough(lua_State* lua) {
  LimitsOf(lua).TripIfRefused();
  Charge(lua, kErrorCost);
}

// The results of pcall are on the stack above its status.
int FinishProtectedCall(lua_State* lua, int status, lua_KContext /*context*/) {
  if (status == LUA_OK || status == LUA_YIELD) {
    RaiseIfTripped(lua);
    return lua_gettop(lua);
  }
  LetLimitsThrough(lua);
  lua_pushboolean(lua, 0);
  lua_insert(lua, -2);
  return 2;
}

int ProtectedCall(lua_State* lua) {
  luaL_checkany(lua, 1);
  lua_pushboolean(lua, 1);  // The first result if the call succeeds.
  lua_insert(lua, 1);
  const int status = lua_pcallk(lua, lua_gettop(lua) - 2, LUA_MULTRET, 0, 0, FinishProtectedCall);
  return FinishProtectedCall(lua, status, 0);
}

lua_State* CheckCoroutine(lua_State* lua, int argument) {
  lua_State* coroutine = lua_tothread(lua, argument);
  luaL_argexpected(lua, coroutine != nullptr, argument, "coroutine");
  return coroutine;
}

// Resumes a coroutine with the topmost `arguments` values. Leaves its results or its error on top
// of lua's stack. Returns the number of results, or -1 on an error.
int Resume(lua_State* lua, lua_State* coroutine, int arguments) {
  // A fresh thread counts instructions from zero: charge in advance for those that its hook may
  // miss.
  Charge(lua, Limits::kHookInterval);
  if (lua_checkstack(coroutine, arguments) == 0) {
    lua_pushliteral(lua, "too many arguments to resume");
    return -1;
  }
  lua_xmove(lua, coroutine, arguments);
  int results = 0;
  const int status = lua_resume(coroutine, lua, arguments, &results);
  if (status != LUA_OK && status != LUA_YIELD) {
    LetLimitsThrough(lua);
    lua_xmove(coroutine, lua, 1);
    return -1;
  }
  RaiseIfTripped(lua);
  if (results > kMaxResults || lua_checkstack(lua, results + 1) == 0) {
    lua_pop(coroutine, results);
    lua_pushliteral(lua, "too many results to resume");
    return -1;
  }
  lua_xmove(coroutine, lua, results);
  return results;
}

int CoroutineResume(lua_State* lua) {
  lua_State* coroutine = CheckCoroutine(lua, 1);
  const int results = Resume(lua, coroutine, lua_gettop(lua) - 1);
  lua_pushboolean(lua, results >= 0 ? 1 : 0);
  const int count = results >= 0 ? results + 1 : 2;
  lua_insert(lua, -count);
  return count;
}

int ResumeWrapped(lua_State* lua) {
  lua_State* coroutine = lua_tothread(lua, lua_upvalueindex(1));
  const int results = Resume(lua, coroutine, lua_gettop(lua));
  if (results >= 0) {
    return results;
  }
  if (const int status = lua_status(coroutine); status != LUA_OK && status != LUA_YIELD) {
    lua_resetthread(coroutine);
    LetLimitsThrough(lua);
  }
  return lua_error(lua);
}

int CoroutineWrap(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TFUNCTION);
  lua_State* coroutine = lua_newthread(lua);
  lua_pushvalue(lua, 1);
  lua_xmove(lua, coroutine, 1);
  lua_pushcclosure(lua, ResumeWrapped, 1);
  return 1;
}

// The upvalue is Lua's coroutine.close, which runs pending close handlers.
int CoroutineClose(lua_State* lua) {
  const int results = CallWrapped(lua);
  RaiseIfTripped(lua);
  return results;
}

// ---- order of keys ----------------------------------------------------------

struct Key {
  enum Rank { kNumber, kText, kBoolean };
  Rank rank;
  long double number = 0.0L;  // Exact for integers and floats.
  std::string_view text;      // Borrowed from the table's key.
};

bool operator<(const Key& a, const Key& b) {
  if (a.rank != b.rank) {
    return a.rank < b.rank;
  }
  return a.rank == Key::kText ? a.text < b.text : a.number < b.number;
}

Key CheckKey(lua_State* lua, int index) {
  switch (lua_type(lua, index)) {
    case LUA_TNUMBER:
      return {Key::kNumber,
              lua_isinteger(lua, index) != 0 ? static_cast<long double>(lua_tointeger(lua, index))
                                             : static_cast<long double>(lua_tonumber(lua, index)),
              {}};
    case LUA_TSTRING: {
      size_t size = 0;
      const char* text = lua_tolstring(lua, index, &size);
      return {Key::kText, 0.0L, {text, size}};
    }
    case LUA_TBOOLEAN:
      return {Key::kBoolean, static_cast<long double>(lua_toboolean(lua, index)), {}};
    default:
      luaL_error(lua,
                 "cannot go through a table with a %s as a key; use numbers, texts or booleans",
                 luaL_typename(lua, index));
      return {};
  }
}

// next(table, key): returns the smallest key that is greater.
int Next(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  lua_settop(lua, 2);
  const bool at_start = lua_isnil(lua, 2);
  const Key after = at_start ? Key{} : CheckKey(lua, 2);
  lua_pushnil(lua);  // Index 3: the best key so far.
  lua_pushnil(lua);  // Index 4: the key of the raw iteration.
  bool found = false;
  Key best = {};
  while (lua_next(lua, 1) != 0) {
    Charge(lua, 1);
    lua_pop(lua, 1);
    const Key key = CheckKey(lua, 4);
    if ((at_start || after < key) && (!found || key < best)) {
      found = true;
      best = key;
      lua_pushvalue(lua, 4);
      lua_replace(lua, 3);
    }
  }
  if (!found) {
    lua_pushnil(lua);
    return 1;
  }
  lua_pushvalue(lua, 3);
  lua_pushvalue(lua, 3);
  lua_rawget(lua, 1);
  return 2;
}

// Iterator of pairs. Upvalues: the sorted keys, the number of visited keys.
// Arguments: the table, the key (unused).
int NextSorted(lua_State* lua) {
  lua_Integer done = lua_tointeger(lua, lua_upvalueindex(2));
  for (;;) {
    Charge(lua, 1);
    if (lua_rawgeti(lua, lua_upvalueindex(1), ++done) == LUA_TNIL) {
      return 1;
    }
    lua_pushvalue(lua, -1);
    if (lua_rawget(lua, 1) != LUA_TNIL) {  // Skip keys that were removed meanwhile.
      lua_pushinteger(lua, done);
      lua_replace(lua, lua_upvalueindex(2));
      return 2;
    }
    lua_pop(lua, 2);
  }
}

// Pushes an array of the keys of the table at index 1, in order.
void PushSortedKeys(lua_State* lua) {
  lua_newtable(lua);  // Keeps the texts alive that `keys` borrows.
  const int unsorted = lua_gettop(lua);
  std::vector<std::pair<Key, lua_Integer>> keys;
  lua_pushnil(lua);
  while (lua_next(lua, 1) != 0) {
    Charge(lua, 8);
    lua_pop(lua, 1);
    keys.emplace_back(CheckKey(lua, -1), static_cast<lua_Integer>(keys.size()) + 1);
    lua_pushvalue(lua, -1);
    lua_rawseti(lua, unsorted, keys.back().second);
  }
  std::sort(keys.begin(), keys.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  lua_createtable(lua, static_cast<int>(keys.size()), 0);
  for (size_t i = 0; i < keys.size(); ++i) {
    lua_rawgeti(lua, unsorted, keys[i].second);
    lua_rawseti(lua, -2, static_cast<lua_Integer>(i) + 1);
  }
}

int Pairs(lua_State* lua) {
  luaL_checkany(lua, 1);
  if (luaL_getmetafield(lua, 1, "__pairs") != LUA_TNIL) {
    lua_pushvalue(lua, 1);
    lua_call(lua, 1, 3);
    return 3;
  }
  luaL_checktype(lua, 1, LUA_TTABLE);
  PushSortedKeys(lua);
  lua_pushinteger(lua, 0);
  lua_pushcclosure(lua, NextSorted, 2);
  lua_pushvalue(lua, 1);
  lua_pushnil(lua);
  return 3;
}

// ---- other functions ---------------------------------------------------------

int SetMetatable(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  const bool removes = lua_isnil(lua, 2);
  luaL_argexpected(lua, removes || lua_istable(lua, 2), 2, "nil or table");
  if (luaL_getmetafield(lua, 1, "__metatable") != LUA_TNIL) {
    return luaL_error(lua, "cannot change a protected metatable");
  }
  if (!removes) {
    // A finaliser would run at an undefined time and outside of all limits.
    lua_pushliteral(lua, "__gc");
    if (lua_rawget(lua, 2) != LUA_TNIL) {
      return luaL_error(lua, "a metatable may not have __gc");
    }
  }
  lua_settop(lua, 2);
  lua_setmetatable(lua, 1);
  return 1;
}

int ToString(lua_State* lua) {
  luaL_checkany(lua, 1);
  PushTextOf(lua, 1);
  return 1;
}

// The upvalue is Lua's tonumber. Texts longer than kLongest are not numbers.
int ToNumber(lua_State* lua) {
  constexpr size_t kLongest = 400;
  if (lua_type(lua, 1) == LUA_TSTRING && lua_rawlen(lua, 1) > kLongest) {
    lua_pushnil(lua);
    return 1;
  }
  return CallWrapped(lua);
}

// Uniform in [0, range].
uint64_t DrawUpTo(Random& random, uint64_t range) {
  if (range < 0xffffffffu) {
    return random.Below(static_cast<uint32_t>(range) + 1);
  }
  uint64_t mask = range;  // Becomes the smallest 2^n - 1 that is not less than `range`.
  for (int shift = 1; shift < 64; shift *= 2) {
    mask |= mask >> shift;
  }
  for (;;) {
    const uint64_t high = random.Next();
    const uint64_t drawn = (high << 32 | random.Next()) & mask;
    if (drawn <= range) {
      return drawn;
    }
  }
}

// math.random([m [, n]])
int DrawRandom(lua_State* lua) {
  Random& random = *static_cast<Random*>(lua_touserdata(lua, lua_upvalueindex(1)));
  if (lua_gettop(lua) == 0) {
    lua_pushnumber(lua, random.Uniform());
    return 1;
  }
  const bool has_low = lua_gettop(lua) > 1;
  const lua_Integer low = has_low ? luaL_checkinteger(lua, 1) : 1;
  const lua_Integer high = luaL_checkinteger(lua, has_low ? 2 : 1);
  luaL_argcheck(lua, low <= high, has_low ? 2 : 1, "interval is empty");
  const uint64_t range = static_cast<uint64_t>(high) - static_cast<uint64_t>(low);
  const uint64_t drawn = static_cast<uint64_t>(low) + DrawUpTo(random, range);
  lua_pushinteger(lua, static_cast<lua_Integer>(drawn));
  return 1;
}

void OpenCoroutines(lua_State* lua) {
  luaL_requiref(lua, "coroutine", luaopen_coroutine, 1);
  WrapField(lua, "resume", CoroutineResume);
  WrapField(lua, "wrap", CoroutineWrap);
  WrapField(lua, "close", CoroutineClose);
  // coroutine.running would expose the coroutine of a task, which only the scheduler may resume.
  lua_pushnil(lua);
  lua_setfield(lua, -2, "running");
  lua_pop(lua, 1);
}

}  // namespace

void PushTextOf(lua_State* lua, int index) {
  if (luaL_callmeta(lua, index, "__tostring") != 0) {
    if (lua_type(lua, -1) != LUA_TSTRING) {
      luaL_error(lua, "'__tostring' must return a string");
    }
    return;
  }
  switch (lua_type(lua, index)) {
    case LUA_TNIL:
    case LUA_TBOOLEAN:
    case LUA_TNUMBER:
    case LUA_TSTRING:
      luaL_tolstring(lua, index, nullptr);
      return;
    default:
      lua_pushstring(lua, luaL_typename(lua, index));
  }
}

void OpenSafeBase(lua_State* lua) {
  constexpr const char* kKept[] = {"assert", "error", "ipairs", "select", "type"};
  luaL_requiref(lua, LUA_GNAME, luaopen_base, 0);  // Fills the globals.
  const int original = lua_gettop(lua);
  lua_newtable(lua);
  for (const char* name : kKept) {
    lua_getfield(lua, original, name);
    lua_setfield(lua, -2, name);
  }
  lua_getfield(lua, original, "tonumber");
  lua_pushcclosure(lua, ToNumber, 1);
  lua_setfield(lua, -2, "tonumber");
  constexpr luaL_Reg kOurs[] = {{"next", Next},           {"pairs", Pairs},
                                {"pcall", ProtectedCall}, {"setmetatable", SetMetatable},
                                {"tostring", ToString},   {nullptr, nullptr}};
  luaL_setfuncs(lua, kOurs, 0);
  // The new table becomes the table of globals.
  lua_rawseti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  lua_pop(lua, 1);
  OpenCoroutines(lua);
}

void OpenSafeMath(lua_State* lua, Random& random) {
  luaL_requiref(lua, "math", luaopen_math, 1);
  lua_pushnil(lua);
  lua_setfield(lua, -2, "randomseed");
  lua_pushlightuserdata(lua, &random);
  lua_pushcclosure(lua, DrawRandom, 1);
  lua_setfield(lua, -2, "random");
  lua_pop(lua, 1);
}

}  // namespace lararium::drama
