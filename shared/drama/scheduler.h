#pragma once

// Runs the coroutines of a drama, tick by tick, in the order of their start. A coroutine
// goes on when something has happened, and only then.

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/drama/sandbox.h"

namespace lararium::drama {

class Scheduler {
 public:
  using TaskId = int64_t;  // never used twice; 0 names nothing
  static constexpr size_t kMaxTasks = 1024;

  static constexpr size_t kMaxOutcomes = 1024;  // the oldest are forgotten

  // How a task ended.
  struct Outcome {
    TaskId id = 0;
    int64_t tick = 0;
    bool failed = false;
    std::string message;
  };

  // on_error hears of every task that ended with an error; on_resume before one goes on.
  // Borrows sandbox.
  Scheduler(Sandbox& sandbox,
            std::function<void(const LuaError&)> on_error,
            std::function<void(TaskId)> on_resume)
      : sandbox_(sandbox), on_error_(std::move(on_error)), on_resume_(std::move(on_resume)) {}

  // Called by functions of a script, and so may raise Lua errors.
  //
  // Takes the function on top of lua's stack for a new task, which begins in
  // this tick.
  TaskId Start(lua_State* lua);
  // Ends a task, running what it has to close. A stale id is fine.
  void Stop(lua_State* lua, TaskId id);
  // The calling task goes on after so many ticks (at least one) ...
  int Wait(lua_State* lua, int64_t ticks);
  // ... or, once all of tasks have ended (any: one of them), in the same tick.
  int Join(lua_State* lua, std::vector<TaskId> tasks, bool any);
  // ... or as soon as something holds, which is asked in each tick; perhaps in this one.
  int WaitUntil(lua_State* lua, const char* function, std::function<bool()> holds);

  bool Alive(TaskId id) const { return Find(id) != nullptr; }
  TaskId running() const { return running_; }
  // Where the running task was started: "drama.lua:12", or "".
  std::string StartedAt() const;
  // When a task that has not ended began.
  std::optional<int64_t> Began(TaskId id) const;
  // nullptr: it has not ended, or that was long ago.
  const Outcome* OutcomeOf(TaskId id) const;

  // Runs all that is due at a tick.
  void Run(int64_t tick);
  // Lets one task go on at a tick, as it did before, whatever it waits for; false: there
  // is no such task.
  bool RunAgain(int64_t tick, TaskId id);
  // After the last of a tick.
  void EndTick();

 private:
  struct Task {
    TaskId id = 0;
    lua_State* thread = nullptr;
    int anchor = 0;         // reference in the registry that keeps the thread
    int64_t wake_tick = 0;  // not before
    std::vector<TaskId> joined;
    bool join_any = false;
    std::function<bool()> until;  // none: nothing
    int64_t began = 0;
    std::string started_at;  // "drama.lua:12"
    bool ended = false;
  };

  Task* Find(TaskId id) const;
  Task& CheckRunning(lua_State* lua, const char* function) const;
  bool Ready(const Task& task) const;
  void Resume(Task& task);
  void End(Task& task);
  void KeepOutcome(Outcome outcome);

  Sandbox& sandbox_;
  std::function<void(const LuaError&)> on_error_;
  std::function<void(TaskId)> on_resume_;
  std::deque<Outcome> outcomes_;
  std::vector<std::unique_ptr<Task>> tasks_;
  TaskId last_id_ = 0;
  TaskId running_ = 0;
  int64_t tick_ = 0;
};

}  // namespace lararium::drama
