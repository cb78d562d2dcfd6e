#include "shared/drama/recording.h"

#include <algorithm>
#include <cstring>

#include "shared/drama/lua_binding.h"

namespace lararium::drama {
namespace {

// Format of a call: number of the function, number of results or kError, then for each result its
// kind and its bytes.
constexpr uint8_t kError = 0xff;
enum RecordKind : uint8_t { kNil, kFalse, kTrue, kInteger, kNumber, kText };

template <typename T>
void AppendBytes(std::vector<uint8_t>& out, const T& value) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(&value);
  out.insert(out.end(), bytes, bytes + sizeof(value));
}

template <typename T>
T ReadBytes(const std::vector<uint8_t>& bytes, size_t& at) {
  T value;
  std::memcpy(&value, &bytes[at], sizeof(value));
  at += sizeof(value);
  return value;
}

}  // namespace

void Recording::AppendText(const char* text, size_t size) {
  entry_.push_back(kText);
  AppendBytes(entry_, static_cast<uint32_t>(size));
  entry_.insert(entry_.end(), text, text + size);
}

// Appends the entry at the position, or moves past it if it is already recorded there.
void Recording::Append() {
  if (at_.bytes < calls_.size()) {
    if (calls_.size() - at_.bytes >= entry_.size() &&
        std::equal(entry_.begin(), entry_.end(),
                   calls_.begin() + static_cast<std::ptrdiff_t>(at_.bytes))) {
      at_.bytes += entry_.size();
      return;
    }
    Truncate();
    ++changes_;
  }
  if (closed_ || calls_.size() + entry_.size() > kMaxBytes) {
    closed_ = true;
    return;
  }
  calls_.insert(calls_.end(), entry_.begin(), entry_.end());
  at_.bytes = calls_.size();
}

void Recording::NoteCall(lua_State* lua, int function, int results) {
  entry_.clear();
  entry_.push_back(static_cast<uint8_t>(function));
  entry_.push_back(static_cast<uint8_t>(results));
  for (int i = lua_gettop(lua) - results + 1; i <= lua_gettop(lua); ++i) {
    switch (lua_type(lua, i)) {
      case LUA_TBOOLEAN:
        entry_.push_back(lua_toboolean(lua, i) != 0 ? kTrue : kFalse);
        break;
      case LUA_TNUMBER:
        if (lua_isinteger(lua, i) != 0) {
          entry_.push_back(kInteger);
          AppendBytes(entry_, lua_tointeger(lua, i));
        } else {
          entry_.push_back(kNumber);
          AppendBytes(entry_, lua_tonumber(lua, i));
        }
        break;
      case LUA_TSTRING: {
        size_t size = 0;
        const char* text = lua_tolstring(lua, i, &size);
        AppendText(text, size);
        break;
      }
      default:
        entry_.push_back(kNil);
    }
  }
  Append();
}

void Recording::NoteError(lua_State* lua, int function) {
  if (LimitsOf(lua).tripped() || lua_type(lua, -1) != LUA_TSTRING) {
    closed_ = true;
    return;
  }
  entry_.clear();
  entry_.push_back(static_cast<uint8_t>(function));
  entry_.push_back(kError);
  size_t size = 0;
  const char* text = lua_tolstring(lua, -1, &size);
  AppendText(text, size);
  Append();
}

void Recording::NoteResume(int64_t tick, int64_t task) {
  if (at_.resumes < resumes_.size()) {
    if (resumes_[at_.resumes] == Resume{tick, task}) {
      ++at_.resumes;
      return;
    }
    Truncate();
    ++changes_;
  }
  if (closed_ || resumes_.size() * sizeof(Resume) > kMaxBytes) {
    closed_ = true;
    return;
  }
  resumes_.push_back({tick, task});
  at_.resumes = resumes_.size();
}

void Recording::Truncate() {
  calls_.resize(at_.bytes);
  resumes_.resize(at_.resumes);
  closed_ = false;
}

int Recording::Replay(lua_State* lua, int function) {
  if (at_.bytes + 2 > calls_.size() || calls_[at_.bytes] != function) {
    diverged_ = true;
    return luaL_error(lua, "the script behaves differently when it is run again");
  }
  const uint8_t count = calls_[at_.bytes + 1];
  at_.bytes += 2;
  const int results = count == kError ? 1 : count;
  luaL_checkstack(lua, results, nullptr);
  for (int i = 0; i < results; ++i) {
    switch (calls_[at_.bytes++]) {
      case kFalse:
        lua_pushboolean(lua, 0);
        break;
      case kTrue:
        lua_pushboolean(lua, 1);
        break;
      case kInteger:
        lua_pushinteger(lua, ReadBytes<lua_Integer>(calls_, at_.bytes));
        break;
      case kNumber:
        lua_pushnumber(lua, ReadBytes<lua_Number>(calls_, at_.bytes));
        break;
      case kText: {
        const auto size = ReadBytes<uint32_t>(calls_, at_.bytes);
        const char* text = reinterpret_cast<const char*>(calls_.data() + at_.bytes);
        at_.bytes += size;
        lua_pushlstring(lua, text, size);
        break;
      }
      default:
        lua_pushnil(lua);
    }
  }
  return count == kError ? lua_error(lua) : results;
}

}  // namespace lararium::drama
