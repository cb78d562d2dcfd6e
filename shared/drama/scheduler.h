#pragma once

// Runs the coroutines of a drama tick by tick, in the order of their start. A coroutine resumes
// only when the event that it waits for has happened.

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
  using TaskId = int64_t;  // Never reused; 0: none.
  static constexpr size_t kMaxTasks = 1024;

  static constexpr size_t kMaxOutcomes = 1024;  // Older outcomes are dropped.

  // Result of a task that has ended.
  struct Outcome {
    TaskId id = 0;
    int64_t tick = 0;
    bool failed = false;
    std::string message;
  };

  // on_error is called for every task that ends with an error, on_resume before a task resumes.
  // Borrows sandbox.
  Scheduler(Sandbox& sandbox,
            std::function<void(const LuaError&)> on_error,
            std::function<void(TaskId)> on_resume)
      : sandbox_(sandbox), on_error_(std::move(on_error)), on_resume_(std::move(on_resume)) {}

  // These functions are called on behalf of a script and may raise Lua errors.
  //
  // Pops the function on top of the stack and starts a task with it, in this tick.
  TaskId Start(lua_State* lua);
  // Ends a task and runs its pending close handlers. Ignores stale ids.
  void Stop(lua_State* lua, TaskId id);
  // Suspends the calling task for a number of ticks, at least one.
  int Wait(lua_State* lua, int64_t ticks);
  // Suspends it until all tasks (any: one of them) have ended; it resumes in the same tick.
  int Join(lua_State* lua, std::vector<TaskId> tasks, bool any);
  // Suspends it until a condition holds. The condition is checked in each tick, also in this one.
  int WaitUntil(lua_State* lua, const char* function, std::function<bool()> holds);

  bool Alive(TaskId id) const { return Find(id) != nullptr; }
  TaskId running() const { return running_; }
  // File and line where the running task was started ("drama.lua:12"), or "".
  std::string StartedAt() const;
  // Tick in which a task began; none if it has ended.
  std::optional<int64_t> Began(TaskId id) const;
  // nullptr: the task has not ended, or its outcome was dropped.
  const Outcome* OutcomeOf(TaskId id) const;

  // Runs all tasks that are due at a tick.
  void Run(int64_t tick);
  // Resumes one task at a tick as in a recording, without checking what it waits for. Returns false
  // if there is no such task.
  bool RunAgain(int64_t tick, TaskId id);
  // Call it after the last task of a tick.
  void EndTick();

 private:
  struct Task {
    TaskId id = 0;
    lua_State* thread = nullptr;
    int anchor = 0;         // Registry reference that keeps the thread alive.
    int64_t wake_tick = 0;  // Earliest tick to resume.
    std::vector<TaskId> joined;
    bool join_any = false;
    std::function<bool()> until;  // Empty: no condition.
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
