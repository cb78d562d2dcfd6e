#pragma once

// The functions of the table `host` that lua/std calls, one set for each subject, and the checks of
// arguments that several sets need. Arguments and results of each function are documented at its
// definition. Internal to shared/drama.

#include "shared/drama/lua_api.h"
#include "shared/drama/script_runtime.h"

namespace lararium::drama {

// Fills the table `host` on top of Lua's stack. The order of the calls numbers the functions in the
// recording.
class HostTable {
 public:
  HostTable(ScriptRuntime& runtime, lua_State* lua) : runtime_(runtime), lua_(lua) {}

  // Adds a function that reads or changes anything but coroutines. Its calls are recorded, and it
  // is not called while the script is replayed.
  template <HostFunction kFunction>
  void AddRecorded(const char* name) {
    Push(name, [](lua_State* lua) {
      const auto index = static_cast<int>(lua_tointeger(lua, lua_upvalueindex(2)));
      return RuntimeOf(lua).CallRecorded(lua, index, kFunction);
    });
  }
  // Adds a function of coroutines and time, or of what never changes. It is called again in a
  // replay.
  template <HostFunction kFunction>
  void AddOwn(const char* name) {
    Push(name, [](lua_State* lua) { return kFunction(RuntimeOf(lua), lua); });
  }

 private:
  static ScriptRuntime& RuntimeOf(lua_State* lua) {
    return *static_cast<ScriptRuntime*>(lua_touserdata(lua, lua_upvalueindex(1)));
  }
  void Push(const char* name, lua_CFunction function);

  ScriptRuntime& runtime_;
  lua_State* lua_;
  int count_ = 0;
};

void AddTaskBindings(HostTable& table);
void AddTimelineBindings(HostTable& table);
void AddVisitorBindings(HostTable& table);
void AddActorBindings(HostTable& table);
void AddObjectBindings(HostTable& table);
void AddLightBindings(HostTable& table);
void AddSoundBindings(HostTable& table);

// Each reads the argument of this index and raises a Lua error if it is not valid.
stage::ActorId CheckActorId(lua_State* lua, int argument);
stage::Actor& CheckActor(ScriptRuntime& run, lua_State* lua, int argument = 1);
// Like CheckActor, for commands. Error: a track leads the actor and would undo the command.
stage::Actor& CheckFreeActor(ScriptRuntime& run, lua_State* lua, int argument = 1);
// Index into human::Human::clips of the actor.
int CheckClip(lua_State* lua, const stage::Actor& actor, int argument);
stage::ObjectId CheckObjectId(lua_State* lua, int argument);
stage::Object& CheckObject(ScriptRuntime& run, lua_State* lua, int argument = 1);

}  // namespace lararium::drama
