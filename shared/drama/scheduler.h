#pragma once

// Runs the coroutines of a drama, tick by tick, in the order of their start.

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "shared/drama/sandbox.h"

namespace lararium::drama {

class Scheduler {
 public:
  using TaskId = int64_t;  // never used twice; 0 names nothing
  static constexpr size_t kMaxTasks = 1024;

  // on_error hears of every task that ended with an error. Borrows sandbox.
  Scheduler(Sandbox& sandbox, std::function<void(const LuaError&)> on_error)
      : sandbox_(sandbox), on_error_(std::move(on_error)) {}

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

  bool Alive(TaskId id) const { return Find(id) != nullptr; }
  TaskId running() const { return running_; }

  // Runs all that is due at a tick.
  void Run(int64_t tick);

 private:
  struct Task {
    TaskId id = 0;
    lua_State* thread = nullptr;
    int anchor = 0;         // reference in the registry that keeps the thread
    int64_t wake_tick = 0;  // not before
    std::vector<TaskId> joined;
    bool join_any = false;
    bool ended = false;
  };

  Task* Find(TaskId id) const;
  Task& CheckRunning(lua_State* lua, const char* function) const;
  bool Ready(const Task& task) const;
  void Resume(Task& task);
  void End(Task& task);

  Sandbox& sandbox_;
  std::function<void(const LuaError&)> on_error_;
  std::vector<std::unique_ptr<Task>> tasks_;
  TaskId last_id_ = 0;
  TaskId running_ = 0;
  int64_t tick_ = 0;
};

}  // namespace lararium::drama
