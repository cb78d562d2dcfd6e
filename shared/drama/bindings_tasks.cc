// Host functions for time, coroutines and the report of tasks.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/script_runtime.h"

namespace lararium::drama {
namespace {

// time() -> seconds
int PushTime(ScriptRuntime& run, lua_State* lua) {
  lua_pushnumber(lua, TimeOf(run.tick()));
  return 1;
}

// wait(seconds)
int Wait(ScriptRuntime& run, lua_State* lua) {
  if (run.IsLoadingChunk()) {
    return luaL_error(lua, "the script cannot wait while it loads; wait in main()");
  }
  const double seconds = std::min(CheckFinite(lua, 1, "the time"), Drama::kMaxTime);
  return run.scheduler().Wait(lua, std::llround(seconds * Drama::kTicksPerSecond));
}

// wait_until(seconds): waits until a time of the drama
int WaitUntilTime(ScriptRuntime& run, lua_State* lua) {
  const double seconds = std::clamp(CheckFinite(lua, 1, "the time"), 0.0, Drama::kMaxTime);
  return run.scheduler().Wait(lua, std::llround(seconds * Drama::kTicksPerSecond) - run.tick());
}

// start(function) -> task
int Start(ScriptRuntime& run, lua_State* lua) {
  lua_settop(lua, 1);
  lua_pushinteger(lua, run.scheduler().Start(lua));
  return 1;
}

// stop(task)
int Stop(ScriptRuntime& run, lua_State* lua) {
  run.scheduler().Stop(lua, luaL_checkinteger(lua, 1));
  return 0;
}

// join(tasks, any)
int Join(ScriptRuntime& run, lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  std::vector<Scheduler::TaskId> tasks;
  for (lua_Integer i = 1; lua_rawgeti(lua, 1, i) == LUA_TNUMBER; ++i) {
    tasks.push_back(lua_tointeger(lua, -1));
    lua_pop(lua, 1);
  }
  return run.scheduler().Join(lua, std::move(tasks), lua_toboolean(lua, 2) != 0);
}

// await(number): waits until a task of the stage is over
int Await(ScriptRuntime& run, lua_State* lua) {
  const auto task = static_cast<stage::TaskId>(luaL_checkinteger(lua, 1));
  return run.scheduler().WaitUntil(lua, "a task", [&run, task] {
    const stage::TaskReport report = run.stage().tasks().report(task);
    return report.over() || report.state == stage::TaskReport::State::kUnknown;
  });
}

// outcome(task) -> whether it is over, whether it succeeded, error message
int PushOutcome(ScriptRuntime& run, lua_State* lua) {
  const Scheduler::TaskId id = luaL_checkinteger(lua, 1);
  const Scheduler::Outcome* outcome = run.scheduler().OutcomeOf(id);
  lua_pushboolean(lua, run.scheduler().Alive(id) ? 0 : 1);
  lua_pushboolean(lua, outcome == nullptr || !outcome->failed ? 1 : 0);
  PushText(lua, outcome == nullptr ? std::string_view() : outcome->message);
  return 3;
}

// await_point(task, point, seconds): waits until `seconds` after the point; negative seconds work
// for points that are known in advance
int AwaitPoint(ScriptRuntime& run, lua_State* lua) {
  const Scheduler::TaskId id = luaL_checkinteger(lua, 1);
  const auto point = SyncPointNamed(CheckText(lua, 2));
  if (!point) {
    return luaL_error(lua,
                      "there is no point '%s'; use start, ready, stroke_start, stroke, "
                      "stroke_end, relax or end",
                      lua_tostring(lua, 2));
  }
  const double seconds = CheckFinite(lua, 3, "the time");
  if (std::abs(seconds) > Drama::kMaxTime) {
    return luaL_error(lua, "the time is out of range");
  }
  const int64_t offset = std::llround(seconds * Drama::kTicksPerSecond);
  return run.scheduler().WaitUntil(lua, "wait_for", [&run, id, point = *point, offset] {
    const int64_t tick = run.PointTick(id, point);
    return tick != SyncRecord::kUnknown && tick + offset <= run.tick();
  });
}

// warn(message): reports a message to the author, with the line of the script
int WarnAuthor(ScriptRuntime& run, lua_State* lua) {
  const std::string where = run.PlaceNow(lua);
  run.Report({where + ": " + std::string(CheckText(lua, 1)), ""});
  return 0;
}

// attempt() -> number: tasks of the calling coroutine may fail from now on; attempt(number): ends
// this
int Attempt(ScriptRuntime& run, lua_State* lua) {
  if (lua_isnoneornil(lua, 1)) {
    lua_pushinteger(lua, run.BeginAttempt());
    return 1;
  }
  run.EndAttempt(luaL_checkinteger(lua, 1));
  return 0;
}

// note_task(actor, action, object's name or nil, begin, whether it failed, message, seconds
// waited): records a task that has ended
int NoteTask(ScriptRuntime& run, lua_State* lua) {
  const stage::Actor& actor = CheckActor(run, lua);
  const std::string_view action = CheckText(lua, 2);
  const std::string_view object = lua_isnil(lua, 3) ? std::string_view() : CheckText(lua, 3);
  const double began = CheckFinite(lua, 4, "the time");
  const std::string_view message = CheckText(lua, 6);
  TaskRecord record = {began,
                       TimeOf(run.tick()),
                       run.PlaceNow(lua),
                       actor.name,
                       std::string(action),
                       std::string(object),
                       lua_toboolean(lua, 5) != 0,
                       run.IsAttempting(),
                       std::string(message),
                       false,
                       luaL_optnumber(lua, 7, 0.0)};
  run.Report(std::move(record));
  return 0;
}

// configure(whether time stops while tracking is lost, patience in seconds, length in seconds)
int Configure(ScriptRuntime& run, lua_State* lua) {
  if (run.declaring() == nullptr) {
    return luaL_error(lua, "drama: only while the script loads, not within main()");
  }
  run.declaring()->settings.hold_when_lost = lua_toboolean(lua, 1) != 0;
  run.declaring()->settings.patience = CheckFinite(lua, 2, "patience");
  run.declaring()->settings.length = CheckFinite(lua, 3, "length");
  return 0;
}

}  // namespace

void AddTaskBindings(HostTable& table) {
  table.AddOwn<PushTime>("time");
  table.AddOwn<Wait>("wait");
  table.AddOwn<WaitUntilTime>("wait_until");
  table.AddOwn<Start>("start");
  table.AddOwn<Stop>("stop");
  table.AddOwn<Join>("join");
  table.AddOwn<Await>("await");
  table.AddOwn<AwaitPoint>("await_point");
  table.AddOwn<PushOutcome>("outcome");
  table.AddOwn<Attempt>("attempt");
  table.AddRecorded<WarnAuthor>("warn");
  table.AddRecorded<NoteTask>("note_task");
  table.AddRecorded<Configure>("configure");
}

}  // namespace lararium::drama
