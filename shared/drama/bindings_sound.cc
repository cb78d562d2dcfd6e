// Host functions for sounds and the audio description.

#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/script_runtime.h"

namespace lararium::drama {
namespace {

// sound(name) -> id, seconds; or nil
int PushSound(ScriptRuntime& run, lua_State* lua) {
  const auto sound = run.stage().sounds().Find(CheckText(lua, 1));
  if (!sound) {
    lua_pushnil(lua);
    return 1;
  }
  lua_pushinteger(lua, *sound);
  lua_pushnumber(lua, run.stage().sounds().seconds(*sound));
  return 2;
}

int CheckSound(ScriptRuntime& run, lua_State* lua) {
  const lua_Integer sound = luaL_checkinteger(lua, 1);
  if (sound < 0 || sound >= static_cast<lua_Integer>(run.stage().sounds().size())) {
    luaL_error(lua, "there is no such sound");
  }
  return static_cast<int>(sound);
}

// play_sound(sound, loops, gain, fade, ease,
//            "listener" | "point", x, y, z | "actor", id | "object", id) -> whether it is heard
int PlaySound(ScriptRuntime& run, lua_State* lua) {
  stage::StageSound sound;
  sound.sound = CheckSound(run, lua);
  sound.loops = lua_toboolean(lua, 2) != 0;
  sound.gain_db = static_cast<float>(CheckFinite(lua, 3, "gain"));
  sound.fade = static_cast<float>(CheckFinite(lua, 4, "fade"));
  sound.ease = CheckEase(lua, CheckText(lua, 5));
  constexpr const char* kPlaces[] = {"listener", "point", "actor", "object", nullptr};
  sound.at = static_cast<stage::StageSound::At>(luaL_checkoption(lua, 6, nullptr, kPlaces));
  if (sound.at == stage::StageSound::At::kPoint) {
    sound.point = {CheckFinite(lua, 7, "x"), CheckFinite(lua, 8, "y"), CheckFinite(lua, 9, "z")};
  } else if (sound.at == stage::StageSound::At::kActor) {
    CheckActor(run, lua, 7);
    sound.actor = CheckActorId(lua, 7);
  } else if (sound.at == stage::StageSound::At::kObject) {
    CheckObject(run, lua, 7);
    sound.object = CheckObjectId(lua, 7);
  }
  lua_pushboolean(lua, run.stage().sounds().Play(sound) != 0);
  return 1;
}

// stop_sound(sound, seconds of fade-out)
int StopSound(ScriptRuntime& run, lua_State* lua) {
  run.stage().sounds().StopAll(CheckSound(run, lua), CheckFinite(lua, 2, "fade"));
  return 0;
}

// describe(line, maximum seconds to wait for a pause) -> whether the line exists
int Describe(ScriptRuntime& run, lua_State* lua) {
  const auto speech = run.stage().FindSpeech(CheckText(lua, 1));
  if (speech) {
    run.stage().Describe(*speech, CheckFinite(lua, 2, "patience"));
  }
  lua_pushboolean(lua, speech.has_value());
  return 1;
}

}  // namespace

void AddSoundBindings(HostTable& table) {
  table.AddRecorded<PushSound>("sound");
  table.AddRecorded<PlaySound>("play_sound");
  table.AddRecorded<StopSound>("stop_sound");
  table.AddRecorded<Describe>("describe");
}

}  // namespace lararium::drama
