// Host functions for sounds and the audio description.

#include "shared/drama/lua_binding.h"
#include "shared/drama/run.h"

namespace lararium::drama {

// sound(name) -> id, seconds; or nil
int Run::PushSound(lua_State* lua) {
  const auto sound = stage_.sounds().Find(CheckText(lua, 1));
  if (!sound) {
    lua_pushnil(lua);
    return 1;
  }
  lua_pushinteger(lua, *sound);
  lua_pushnumber(lua, stage_.sounds().seconds(*sound));
  return 2;
}

int Run::CheckSound(lua_State* lua) {
  const lua_Integer sound = luaL_checkinteger(lua, 1);
  if (sound < 0 || sound >= static_cast<lua_Integer>(stage_.sounds().size())) {
    luaL_error(lua, "there is no such sound");
  }
  return static_cast<int>(sound);
}

// play_sound(sound, loops, gain, fade, ease,
//            "listener" | "point", x, y, z | "actor", id | "object", id) -> whether it is heard
int Run::PlaySound(lua_State* lua) {
  stage::StageSound sound;
  sound.sound = CheckSound(lua);
  sound.loops = lua_toboolean(lua, 2) != 0;
  sound.gain_db = static_cast<float>(CheckFinite(lua, 3, "gain"));
  sound.fade = static_cast<float>(CheckFinite(lua, 4, "fade"));
  sound.ease = CheckEase(lua, CheckText(lua, 5));
  constexpr const char* kPlaces[] = {"listener", "point", "actor", "object", nullptr};
  sound.at = static_cast<stage::StageSound::At>(luaL_checkoption(lua, 6, nullptr, kPlaces));
  if (sound.at == stage::StageSound::At::kPoint) {
    sound.point = {CheckFinite(lua, 7, "x"), CheckFinite(lua, 8, "y"), CheckFinite(lua, 9, "z")};
  } else if (sound.at == stage::StageSound::At::kActor) {
    CheckActor(lua, 7);
    sound.actor = CheckActorId(lua, 7);
  } else if (sound.at == stage::StageSound::At::kObject) {
    CheckObject(lua, 7);
    sound.object = CheckObjectId(lua, 7);
  }
  lua_pushboolean(lua, stage_.sounds().Play(sound) != 0);
  return 1;
}

// stop_sound(sound, seconds of fade-out)
int Run::StopSound(lua_State* lua) {
  stage_.sounds().StopAll(CheckSound(lua), CheckFinite(lua, 2, "fade"));
  return 0;
}

// describe(line, maximum seconds to wait for a pause) -> whether the line exists
int Run::Describe(lua_State* lua) {
  const auto speech = stage_.FindSpeech(CheckText(lua, 1));
  if (speech) {
    stage_.Describe(*speech, CheckFinite(lua, 2, "patience"));
  }
  lua_pushboolean(lua, speech.has_value());
  return 1;
}

}  // namespace lararium::drama
