// Host functions for actors with objects and with each other, and for objects.

#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>

#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/script_runtime.h"

namespace lararium::drama {
namespace {

glm::quat HeadingRotation(double heading) {
  return glm::angleAxis(static_cast<float>(heading), glm::vec3(0.0f, 1.0f, 0.0f));
}

float HeadingOfObject(const stage::Pose& pose) {
  const glm::vec3 forward = pose.rotation * glm::vec3(0.0f, 0.0f, -1.0f);
  return stage::HeadingOf({forward.x, forward.z});
}

// Index into ObjectUse::surfaces; -1 (any) if the argument is nil.
int CheckSurface(lua_State* lua, const stage::Object& object, int argument) {
  if (lua_isnoneornil(lua, argument)) {
    return -1;
  }
  const std::string_view name = CheckText(lua, argument);
  const std::vector<stage::Surface>& surfaces = object.use().surfaces;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].name == name) {
      return static_cast<int>(i);
    }
  }
  luaL_error(lua, "'%s' has no surface '%s'", object.name.c_str(), lua_tostring(lua, argument));
  return -1;
}

// Pushes the number of the task, or nil and the error.
int PushTask(ScriptRuntime& run, lua_State* lua, const Result<stage::TaskId>& task) {
  if (task.ok()) {
    run.NoteTaskSync(*task);
    lua_pushinteger(lua, static_cast<lua_Integer>(*task));
    return 1;
  }
  lua_pushnil(lua);
  PushText(lua, task.message());
  return 2;
}

// task(number) -> "waiting" | "running" | "done" | "failed", message, seconds waited
int PushTaskState(ScriptRuntime& run, lua_State* lua) {
  const stage::TaskReport report =
      run.stage().tasks().report(static_cast<stage::TaskId>(luaL_checkinteger(lua, 1)));
  constexpr const char* kNames[] = {"failed", "waiting", "running", "done", "failed"};
  lua_pushstring(lua, kNames[static_cast<size_t>(report.state)]);
  PushText(lua, report.message);
  lua_pushnumber(lua, static_cast<lua_Number>(report.waited));
  return 3;
}

// stop_task(number): ends the task if it is not over, and forgets it
int StopTask(ScriptRuntime& run, lua_State* lua) {
  const auto task = static_cast<stage::TaskId>(luaL_checkinteger(lua, 1));
  run.stage().tasks().Stop(task);
  run.stage().tasks().Forget(task);
  return 0;
}

// walk(actor, x, z, heading or nil, speed) -> task
int Walk(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  const glm::vec2 goal = {CheckFinite(lua, 2, "x"), CheckFinite(lua, 3, "z")};
  std::optional<float> heading;
  if (!lua_isnil(lua, 4)) {
    heading = static_cast<float>(CheckFinite(lua, 4, "heading"));
  }
  const auto speed = static_cast<float>(CheckFinite(lua, 5, "speed"));
  return PushTask(run, lua, run.stage().tasks().Walk(CheckActorId(lua, 1), goal, heading, speed));
}

// turn(actor, heading, radians per second) -> task
int Turn(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  const auto heading = static_cast<float>(CheckFinite(lua, 2, "heading"));
  const auto speed = static_cast<float>(CheckFinite(lua, 3, "speed"));
  return PushTask(run, lua, run.stage().tasks().Turn(CheckActorId(lua, 1), heading, speed));
}

// stand_up(actor) -> task
int StandUp(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  return PushTask(run, lua, run.stage().tasks().Stand(CheckActorId(lua, 1)));
}

// use(actor, object, action or nil, seconds) -> task
int Use(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  const std::vector<stage::ObjectAction>& actions = CheckObject(run, lua, 2).use().actions;
  const std::string_view first = actions.empty() ? std::string_view() : actions.front().name;
  const auto seconds = static_cast<float>(CheckFinite(lua, 4, "seconds"));
  return PushTask(run, lua,
                  run.stage().tasks().Use(CheckActorId(lua, 1), CheckObjectId(lua, 2),
                                          lua_isnil(lua, 3) ? first : CheckText(lua, 3), seconds));
}

// take(actor, object) -> task
int Take(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  return PushTask(run, lua, run.stage().tasks().Take(CheckActorId(lua, 1), CheckObjectId(lua, 2)));
}

// put(actor, object, other object, surface or nil) or put(actor, object, nil, x, z, heading or nil)
int Put(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  stage::PutTarget target;
  if (!lua_isnil(lua, 3)) {
    target.object = CheckObjectId(lua, 3);
    target.surface = CheckSurface(lua, CheckObject(run, lua, 3), 4);
  } else {
    target.place = {CheckFinite(lua, 4, "x"), CheckFinite(lua, 5, "z")};
    if (!lua_isnil(lua, 6)) {
      target.heading = static_cast<float>(CheckFinite(lua, 6, "heading"));
    }
  }
  return PushTask(run, lua,
                  run.stage().tasks().Put(CheckActorId(lua, 1), CheckObjectId(lua, 2), target));
}

// give(actor, object, other actor) -> task
int Give(ScriptRuntime& run, lua_State* lua) {
  CheckFreeActor(run, lua);
  return PushTask(
      run, lua,
      run.stage().tasks().Give(CheckActorId(lua, 1), CheckObjectId(lua, 2), CheckActorId(lua, 3)));
}

// object(name) -> id or nil
int PushObject(ScriptRuntime& run, lua_State* lua) {
  if (const auto id = run.stage().FindObject(CheckText(lua, 1))) {
    lua_pushinteger(lua, PackId(*id));
  } else {
    lua_pushnil(lua);
  }
  return 1;
}

// object_pose(object) -> x, y, z, heading
int PushObjectPose(ScriptRuntime& run, lua_State* lua) {
  const stage::Pose& pose = CheckObject(run, lua).state.stage_from_object;
  for (const float value :
       {pose.position.x, pose.position.y, pose.position.z, HeadingOfObject(pose)}) {
    lua_pushnumber(lua, value);
  }
  return 4;
}

// place_object(object, x, y, z, heading)
int PlaceObject(ScriptRuntime& run, lua_State* lua) {
  CheckObject(run, lua);
  const glm::vec3 position = {CheckFinite(lua, 2, "x"), CheckFinite(lua, 3, "y"),
                              CheckFinite(lua, 4, "z")};
  run.stage().Place(CheckObjectId(lua, 1),
                    stage::Pose{position, HeadingRotation(CheckFinite(lua, 5, "heading"))});
  return 0;
}

// place_object_on(object, other object, surface or nil, spot or nil): spots count from 1; nil
// chooses the first free one
int PlaceObjectOn(ScriptRuntime& run, lua_State* lua) {
  const stage::Object& base = CheckObject(run, lua, 2);
  CheckObject(run, lua);
  const int wanted_surface = CheckSurface(lua, base, 3);
  const lua_Integer wanted_spot = luaL_optinteger(lua, 4, 0);
  const std::vector<stage::Surface>& surfaces = base.use().surfaces;
  Status last = Status::Error("'" + base.name + "'", "has no such spot");
  for (size_t surface = 0; surface < surfaces.size(); ++surface) {
    for (size_t spot = 0; spot < surfaces[surface].spots.size(); ++spot) {
      if ((wanted_surface >= 0 && wanted_surface != static_cast<int>(surface)) ||
          (wanted_spot > 0 && wanted_spot != static_cast<lua_Integer>(spot) + 1)) {
        continue;
      }
      last = run.stage().PlaceOn(
          CheckObjectId(lua, 1),
          {CheckObjectId(lua, 2), static_cast<int8_t>(surface), static_cast<int8_t>(spot), 0.0f});
      if (last.ok()) {
        return 0;
      }
    }
  }
  return luaL_error(lua, "%s", last.message().c_str());
}

// show_object(object, visible)
int ShowObject(ScriptRuntime& run, lua_State* lua) {
  CheckObject(run, lua).state.visible = lua_toboolean(lua, 2) != 0;
  return 0;
}

// object_state(object) -> name
int PushObjectState(ScriptRuntime& run, lua_State* lua) {
  const stage::Object& object = CheckObject(run, lua);
  PushText(lua, object.use().states[static_cast<size_t>(object.state.state)]);
  return 1;
}

// set_object_state(object, name)
int SetObjectState(ScriptRuntime& run, lua_State* lua) {
  const stage::Object& object = CheckObject(run, lua);
  const int state = object.use().FindState(CheckText(lua, 2));
  if (state < 0) {
    std::string known;
    for (const std::string& name : object.use().states) {
      known += (known.empty() ? "" : ", ") + name;
    }
    return luaL_error(lua, "'%s' has no state '%s'; it has %s", object.name.c_str(),
                      lua_tostring(lua, 2), known.c_str());
  }
  run.stage().SetState(CheckObjectId(lua, 1), state);
  return 0;
}

// holder(object) -> name of the actor who holds it, or nil
int PushHolder(ScriptRuntime& run, lua_State* lua) {
  if (const stage::Actor* holder = run.stage().Find(CheckObject(run, lua).state.holder)) {
    PushText(lua, holder->name);
  } else {
    lua_pushnil(lua);
  }
  return 1;
}

}  // namespace

stage::Object& CheckObject(ScriptRuntime& run, lua_State* lua, int argument) {
  stage::Object* object = run.stage().Find(CheckObjectId(lua, argument));
  if (object == nullptr) {
    luaL_error(lua, "the object has left the stage");
  }
  return *object;
}

stage::ObjectId CheckObjectId(lua_State* lua, int argument) {
  return UnpackId<stage::Object>(luaL_checkinteger(lua, argument));
}

void AddObjectBindings(HostTable& table) {
  table.AddRecorded<PushTaskState>("task");
  table.AddRecorded<StopTask>("stop_task");
  table.AddRecorded<Walk>("walk");
  table.AddRecorded<Turn>("turn");
  table.AddRecorded<StandUp>("stand_up");
  table.AddRecorded<Use>("use");
  table.AddRecorded<Take>("take");
  table.AddRecorded<Put>("put");
  table.AddRecorded<Give>("give");
  table.AddRecorded<PushObject>("object");
  table.AddRecorded<PushObjectPose>("object_pose");
  table.AddRecorded<PlaceObject>("place_object");
  table.AddRecorded<PlaceObjectOn>("place_object_on");
  table.AddRecorded<ShowObject>("show_object");
  table.AddRecorded<PushObjectState>("object_state");
  table.AddRecorded<SetObjectState>("set_object_state");
  table.AddRecorded<PushHolder>("holder");
}

}  // namespace lararium::drama
