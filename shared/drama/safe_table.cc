// The tables `table` and `utf8` for scripts. Lua's functions loop in C over lengths that a script
// chooses (a __len, two arguments), so the work is charged before each loop.

#include <bit>
#include <numeric>
#include <vector>

#include "shared/drama/lua_binding.h"
#include "shared/drama/safe_libraries.h"

namespace lararium::drama {
namespace {

// Charges for the indices from first to last.
void ChargeRange(lua_State* lua, lua_Integer first, lua_Integer last) {
  constexpr int64_t kMax = int64_t{1} << 40;
  if (first > last) {
    return;
  }
  const uint64_t count = static_cast<uint64_t>(last) - static_cast<uint64_t>(first);
  Charge(lua, count >= static_cast<uint64_t>(kMax) ? kMax : static_cast<int64_t>(count) + 1);
}

// concat(list, separator, i, j). i and j are made explicit, so that Lua uses the range that was
// charged.
int Concat(lua_State* lua) {
  lua_settop(lua, 4);
  const lua_Integer first = luaL_optinteger(lua, 3, 1);
  const lua_Integer last = lua_isnoneornil(lua, 4) ? luaL_len(lua, 1) : luaL_checkinteger(lua, 4);
  ChargeRange(lua, first, last);
  lua_pushinteger(lua, first);
  lua_replace(lua, 3);
  lua_pushinteger(lua, last);
  lua_replace(lua, 4);
  return CallWrapped(lua);
}

// unpack(list, i, j)
int Unpack(lua_State* lua) {
  lua_settop(lua, 3);
  const lua_Integer first = luaL_optinteger(lua, 2, 1);
  const lua_Integer last = lua_isnoneornil(lua, 3) ? luaL_len(lua, 1) : luaL_checkinteger(lua, 3);
  if (first > last) {
    return 0;
  }
  if (static_cast<uint64_t>(last) - static_cast<uint64_t>(first) >= kMaxResults) {
    return luaL_error(lua, "too many results to unpack");
  }
  const auto count = static_cast<int>(last - first + 1);
  luaL_checkstack(lua, count, "too many results to unpack");
  for (int i = 0; i < count; ++i) {
    lua_geti(lua, 1, first + i);
  }
  return count;
}

// move(from, first, last, to_index, to)
int Move(lua_State* lua) {
  ChargeRange(lua, luaL_checkinteger(lua, 2), luaL_checkinteger(lua, 3));
  return CallWrapped(lua);
}

int Insert(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  const lua_Integer end = luaL_len(lua, 1) + 1;
  const int arguments = lua_gettop(lua);
  if (arguments != 2 && arguments != 3) {
    return luaL_error(lua, "wrong number of arguments to 'insert'");
  }
  const lua_Integer position = arguments == 2 ? end : luaL_checkinteger(lua, 2);
  luaL_argcheck(lua, position >= 1 && position <= end, 2, "position out of bounds");
  ChargeRange(lua, position, end);
  for (lua_Integer i = end; i > position; --i) {
    lua_geti(lua, 1, i - 1);
    lua_seti(lua, 1, i);
  }
  lua_seti(lua, 1, position);  // Stores the last argument.
  return 0;
}

int Remove(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  const lua_Integer size = luaL_len(lua, 1);
  const lua_Integer position = luaL_optinteger(lua, 2, size);
  const bool in_bounds =
      position == size || (position >= 1 && (position <= size || position - 1 == size));
  luaL_argcheck(lua, in_bounds, 2, "position out of bounds");
  ChargeRange(lua, position, size);
  lua_geti(lua, 1, position);
  lua_Integer i = position;
  for (; i < size; ++i) {
    lua_geti(lua, 1, i + 1);
    lua_seti(lua, 1, i);
  }
  lua_pushnil(lua);
  lua_seti(lua, 1, i);
  return 1;
}

// Whether element a of the array at index 3 must come before element b, by the function at index 2
// or, without one, by '<'.
bool ComesBefore(lua_State* lua, lua_Integer a, lua_Integer b) {
  const bool by_function = !lua_isnil(lua, 2);
  if (by_function) {
    lua_pushvalue(lua, 2);
  }
  lua_rawgeti(lua, 3, a);
  lua_rawgeti(lua, 3, b);
  bool before = false;
  if (by_function) {
    lua_call(lua, 2, 1);
    before = lua_toboolean(lua, -1) != 0;
    lua_pop(lua, 1);
  } else {
    before = lua_compare(lua, -2, -1, LUA_OPLT) != 0;
    lua_pop(lua, 2);
  }
  return before;
}

// Merge sort of the indices 1..count. Safe for any order function, even an inconsistent one.
std::vector<lua_Integer> SortedIndices(lua_State* lua, size_t count) {
  std::vector<lua_Integer> sorted(count);
  std::iota(sorted.begin(), sorted.end(), 1);
  std::vector<lua_Integer> merged(count);
  for (size_t width = 1; width < count; width *= 2) {
    for (size_t begin = 0; begin < count; begin += 2 * width) {
      const size_t middle = std::min(begin + width, count);
      const size_t end = std::min(begin + 2 * width, count);
      size_t left = begin;
      size_t right = middle;
      for (size_t i = begin; i < end; ++i) {
        const bool take_right =
            left == middle || (right < end && ComesBefore(lua, sorted[right], sorted[left]));
        merged[i] = take_right ? sorted[right++] : sorted[left++];
      }
    }
    sorted.swap(merged);
  }
  return sorted;
}

// Replaces Lua's sort, which chooses pivots by the clock and is not stable.
int Sort(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  lua_settop(lua, 2);
  if (!lua_isnil(lua, 2)) {
    luaL_checktype(lua, 2, LUA_TFUNCTION);
  }
  const lua_Integer size = luaL_len(lua, 1);
  ChargeRange(lua, 1, size);
  const auto count = static_cast<size_t>(std::max<lua_Integer>(size, 0));
  Charge(lua, static_cast<int64_t>(count) * std::bit_width(count));
  lua_createtable(lua, static_cast<int>(count), 0);  // Index 3: the original elements.
  for (lua_Integer i = 1; i <= size; ++i) {
    lua_geti(lua, 1, i);
    lua_rawseti(lua, 3, i);
  }
  const std::vector<lua_Integer> sorted = SortedIndices(lua, count);
  for (size_t i = 0; i < count; ++i) {
    lua_rawgeti(lua, 3, sorted[i]);
    lua_seti(lua, 1, static_cast<lua_Integer>(i) + 1);
  }
  return 0;
}

}  // namespace

void OpenSafeTable(lua_State* lua) {
  constexpr luaL_Reg kOurs[] = {{"insert", Insert},
                                {"remove", Remove},
                                {"sort", Sort},
                                {"unpack", Unpack},
                                {nullptr, nullptr}};
  luaL_requiref(lua, LUA_TABLIBNAME, luaopen_table, 1);
  WrapField(lua, "concat", Concat);
  WrapField(lua, "move", Move);
  luaL_setfuncs(lua, kOurs, 0);
  lua_pop(lua, 1);

  luaL_requiref(lua, LUA_UTF8LIBNAME, luaopen_utf8, 1);
  for (const char* name : {"codepoint", "len", "offset"}) {
    WrapField(lua, name, CallOnText);
  }
  lua_pop(lua, 1);
}

}  // namespace lararium::drama
