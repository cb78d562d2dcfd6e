// Host functions for actors by themselves.

#include <string>

#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/script_runtime.h"

namespace lararium::drama {
namespace {

// actor(name) -> id or nil
int PushActor(ScriptRuntime& run, lua_State* lua) {
  if (const auto id = run.stage().Find(CheckText(lua, 1))) {
    lua_pushinteger(lua, PackId(*id));
  } else {
    lua_pushnil(lua);
  }
  return 1;
}

// clip(actor, name) -> duration, stride; or nil
int PushClip(ScriptRuntime& run, lua_State* lua) {
  const human::Human& human = CheckActor(run, lua).human();
  const int clip = lua_type(lua, 2) == LUA_TSTRING ? stage::FindClip(human, CheckText(lua, 2))
                                                   : human::Animation::kNoClip;
  if (clip == human::Animation::kNoClip) {
    lua_pushnil(lua);
    return 1;
  }
  lua_pushnumber(lua, human.clips[static_cast<size_t>(clip)].duration);
  lua_pushnumber(lua, human.clips[static_cast<size_t>(clip)].stride);
  return 2;
}

// playing(actor) -> name of the current clip, or nil
int PushPlaying(ScriptRuntime& run, lua_State* lua) {
  const stage::Actor& actor = CheckActor(run, lua);
  const int clip = actor.state.animation_state.animation.clip;
  if (clip == human::Animation::kNoClip) {
    lua_pushnil(lua);
  } else {
    PushText(lua, actor.human().clips[static_cast<size_t>(clip)].name);
  }
  return 1;
}

// play(actor, clip or nil, fade, rate)
int Play(ScriptRuntime& run, lua_State* lua) {
  stage::Actor& actor = CheckFreeActor(run, lua);
  const int clip = lua_isnil(lua, 2) ? human::Animation::kNoClip : CheckClip(lua, actor, 2);
  const auto fade = static_cast<float>(CheckFinite(lua, 3, "fade"));
  const double rate = CheckFinite(lua, 4, "rate");
  human::Animation& animation = actor.state.animation_state.animation;
  const bool goes_on = animation.clip == clip && animation.rate == rate &&
                       (clip < 0 || actor.human().clips[static_cast<size_t>(clip)].loops);
  if (!goes_on) {
    human::StartClip(animation, clip, rate, fade);
  }
  actor.clip_after = clip;
  actor.clip_ends = -1.0;
  run.NoteBlock(lua, actor, lua_isnil(lua, 2) ? "play" : "play " + std::string(CheckText(lua, 2)),
                0.0);
  return 0;
}

// gesture(actor, clip, part) -> duration
int Gesture(ScriptRuntime& run, lua_State* lua) {
  const stage::Actor& actor = CheckFreeActor(run, lua);
  const int clip = CheckClip(lua, actor, 2);
  constexpr const char* kParts[] = {"whole", "upper", "arms", "head", nullptr};
  const int part = luaL_checkoption(lua, 3, nullptr, kParts);
  run.stage().Gesture(CheckActorId(lua, 1), clip, static_cast<human::BodyPart>(part));
  const human::Clip& played = actor.human().clips[static_cast<size_t>(clip)];
  run.NoteSync(GestureTimes(played, actor.model->turned[static_cast<size_t>(clip)],
                            stage::Stage::kClipFade));
  run.NoteBlock(lua, actor, "gesture " + played.name, played.duration);
  lua_pushnumber(lua, played.duration);
  return 1;
}

// pose(actor) -> x, y, z, heading
int PushPose(ScriptRuntime& run, lua_State* lua) {
  const stage::ActorState& state = CheckActor(run, lua).state;
  for (const float value : {state.position.x, state.position.y, state.position.z, state.heading}) {
    lua_pushnumber(lua, value);
  }
  return 4;
}

// place(actor, x, y, z, heading)
int PlaceActor(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  const glm::vec3 position = {CheckFinite(lua, 2, "x"), CheckFinite(lua, 3, "y"),
                              CheckFinite(lua, 4, "z")};
  run.stage().Place(CheckActorId(lua, 1), position,
                    static_cast<float>(CheckFinite(lua, 5, "heading")));
  run.NoteBlock(lua, CheckActor(run, lua), "place", 0.0);
  return 0;
}

// show(actor, visible)
int Show(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  run.stage().Show(CheckActorId(lua, 1), lua_toboolean(lua, 2) != 0);
  return 0;
}

// look(actor, "self" | "nothing" | "visitor" | "actor", id | "object", id | "point", x, y, z)
int Look(ScriptRuntime& run, lua_State* lua) {
  using Target = stage::Attention::Target;
  stage::Attention& attention = CheckActor(run, lua).attention;
  constexpr const char* kTargets[] = {"nothing", "point", "actor", "object",
                                      "visitor", "self",  nullptr};
  const int target = luaL_checkoption(lua, 2, nullptr, kTargets);
  if (std::string_view(kTargets[target]) == "self") {
    attention.told.reset();
    attention.seconds_left = 0.0f;
    return 0;
  }
  stage::Attention::Choice choice;
  choice.target = static_cast<Target>(target);
  if (choice.target == Target::kPoint) {
    choice.point = {CheckFinite(lua, 3, "x"), CheckFinite(lua, 4, "y"), CheckFinite(lua, 5, "z")};
  } else if (choice.target == Target::kActor) {
    CheckActor(run, lua, 3);
    choice.actor = CheckActorId(lua, 3);
  } else if (choice.target == Target::kObject) {
    CheckObject(run, lua, 3);
    choice.object = CheckObjectId(lua, 3);
  }
  attention.told = choice;
  run.NoteBlock(lua, CheckActor(run, lua), "look_at", 0.0);
  return 0;
}

// attend(actor, on): whether the actor chooses what to look at by itself
int Attend(ScriptRuntime& run, lua_State* lua) {
  CheckActor(run, lua).attention.automatic = lua_toboolean(lua, 2) != 0;
  return 0;
}

// express(actor, name, intensity, fade, ease)
int Express(ScriptRuntime& run, lua_State* lua) {
  stage::Actor& actor = CheckActor(run, lua);
  const auto expression = human::ExpressionNamed(CheckText(lua, 2));
  if (!expression) {
    return luaL_error(lua,
                      "express: there is no expression '%s'; use joy, sadness, anger, fear, "
                      "disgust, surprise or neutral",
                      lua_tostring(lua, 2));
  }
  human::SetExpression(actor.state.animation_state.face, *expression,
                       static_cast<float>(CheckFinite(lua, 3, "intensity")),
                       static_cast<float>(CheckFinite(lua, 4, "fade")),
                       CheckEase(lua, CheckText(lua, 5)));
  run.NoteBlock(lua, actor, "express " + std::string(CheckText(lua, 2)),
                CheckFinite(lua, 4, "fade"));
  return 0;
}

// say(actor, line or nil) -> duration, or nil if there is no line with this id
int Say(ScriptRuntime& run, lua_State* lua) {
  CheckActor(run, lua);
  if (lua_isnil(lua, 2)) {
    run.stage().Say(CheckActorId(lua, 1), -1);
    return 0;
  }
  const auto speech = run.stage().FindSpeech(CheckText(lua, 2));
  if (!speech) {
    lua_pushnil(lua);
    return 1;
  }
  run.stage().Say(CheckActorId(lua, 1), *speech);
  run.NoteSync(SpeechTimes(run.stage().SpeechTrack(*speech)));
  run.NoteBlock(lua, CheckActor(run, lua), "say " + std::string(CheckText(lua, 2)),
                run.stage().SpeechSeconds(*speech));
  lua_pushnumber(lua, run.stage().SpeechSeconds(*speech));
  return 1;
}

// Arguments: actor, "gesture" | "say", clip or line -> seconds to each synchronisation point.
int Foretell(ScriptRuntime& run, lua_State* lua) {
  const stage::Actor& actor = CheckActor(run, lua);
  constexpr const char* kWhat[] = {"gesture", "say", nullptr};
  SyncTimes times = {};
  if (luaL_checkoption(lua, 2, nullptr, kWhat) == 0) {
    const auto clip = static_cast<size_t>(CheckClip(lua, actor, 3));
    times =
        GestureTimes(actor.human().clips[clip], actor.model->turned[clip], stage::Stage::kClipFade);
  } else {
    const auto speech = run.stage().FindSpeech(CheckText(lua, 3));
    if (!speech) {
      return luaL_error(lua, "there is no line '%s'", lua_tostring(lua, 3));
    }
    times = SpeechTimes(run.stage().SpeechTrack(*speech));
  }
  for (const double time : times) {
    lua_pushnumber(lua, time);
  }
  return stage::kSyncPoints;
}

// gait(actor, style) -> whether the style exists; gait(actor, name, value)
int SetGait(ScriptRuntime& run, lua_State* lua) {
  human::GaitStyle& style = CheckActor(run, lua).state.animation_state.locomotion.style;
  if (lua_isnoneornil(lua, 3)) {
    const auto named = human::GaitStyleNamed(CheckText(lua, 2));
    style = named.value_or(style);
    lua_pushboolean(lua, named.has_value());
    return 1;
  }
  constexpr const char* kNames[] = {"cadence",    "step_width", "stoop", "arm_swing",
                                    "arm_spread", "sway",       "lift",  nullptr};
  float* const values[] = {&style.cadence,    &style.step_width, &style.stoop, &style.arm_swing,
                           &style.arm_spread, &style.sway,       &style.lift};
  const int which = luaL_checkoption(lua, 2, nullptr, kNames);
  *values[which] = static_cast<float>(CheckFinite(lua, 3, kNames[which]));
  return 0;
}

}  // namespace

stage::Actor& CheckActor(ScriptRuntime& run, lua_State* lua, int argument) {
  stage::Actor* actor = run.stage().Find(CheckActorId(lua, argument));
  if (actor == nullptr) {
    luaL_error(lua, "the actor has left the stage");
  }
  return *actor;
}

stage::Actor& CheckFreeActor(ScriptRuntime& run, lua_State* lua, int argument) {
  stage::Actor& actor = CheckActor(run, lua, argument);
  if (actor.led) {
    luaL_error(lua, "'%s' is led by a track", actor.name.c_str());
  }
  return actor;
}

stage::ActorId CheckActorId(lua_State* lua, int argument) {
  return UnpackId<stage::Actor>(luaL_checkinteger(lua, argument));
}

int CheckClip(lua_State* lua, const stage::Actor& actor, int argument) {
  const int clip = stage::FindClip(actor.human(), CheckText(lua, argument));
  if (clip == human::Animation::kNoClip) {
    luaL_error(lua, "'%s' has no clip '%s'", actor.name.c_str(), lua_tostring(lua, argument));
  }
  return clip;
}

void AddActorBindings(HostTable& table) {
  table.AddRecorded<Foretell>("foretell");
  table.AddRecorded<PushActor>("actor");
  table.AddRecorded<PushClip>("clip");
  table.AddRecorded<PushPlaying>("playing");
  table.AddRecorded<Play>("play");
  table.AddRecorded<Gesture>("gesture");
  table.AddRecorded<PushPose>("pose");
  table.AddRecorded<PlaceActor>("place");
  table.AddRecorded<Show>("show");
  table.AddRecorded<Look>("look");
  table.AddRecorded<Attend>("attend");
  table.AddRecorded<Express>("express");
  table.AddRecorded<Say>("say");
  table.AddRecorded<SetGait>("gait");
}

}  // namespace lararium::drama
