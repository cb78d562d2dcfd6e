#include "shared/drama/scheduler.h"

#include <algorithm>

#include "shared/drama/lua_binding.h"

namespace lararium::drama {

Scheduler::TaskId Scheduler::Start(lua_State* lua) {
  luaL_checktype(lua, -1, LUA_TFUNCTION);
  if (tasks_.size() >= kMaxTasks) {
    luaL_error(lua, "more than %d tasks at once", static_cast<int>(kMaxTasks));
  }
  auto task = std::make_unique<Task>();
  task->thread = lua_newthread(lua);
  lua_insert(lua, -2);
  lua_xmove(lua, task->thread, 1);
  task->anchor = luaL_ref(lua, LUA_REGISTRYINDEX);
  task->id = ++last_id_;
  task->began = tick_;
  task->started_at = PlaceOf(lua);
  tasks_.push_back(std::move(task));
  return last_id_;
}

void Scheduler::KeepOutcome(Outcome outcome) {
  outcomes_.push_back(std::move(outcome));
  if (outcomes_.size() > kMaxOutcomes) {
    outcomes_.pop_front();
  }
}

void Scheduler::Stop(lua_State* lua, TaskId id) {
  Task* task = Find(id);
  if (task == nullptr) {
    return;
  }
  if (id == running_) {
    luaL_error(lua, "a task cannot stop itself; return from its function");
  }
  KeepOutcome({id, tick_, true, "was stopped"});
  End(*task);
  RaiseIfTripped(lua);
}

int Scheduler::Wait(lua_State* lua, int64_t ticks) {
  Task& task = CheckRunning(lua, "wait");
  task.wake_tick = tick_ + std::max<int64_t>(ticks, 1);
  return lua_yield(lua, 0);
}

int Scheduler::Join(lua_State* lua, std::vector<TaskId> tasks, bool any) {
  Task& task = CheckRunning(lua, "together and race");
  task.joined = std::move(tasks);
  task.join_any = any;
  return lua_yield(lua, 0);
}

int Scheduler::WaitUntil(lua_State* lua, const char* function, std::function<bool()> holds) {
  CheckRunning(lua, function).until = std::move(holds);
  return lua_yield(lua, 0);
}

std::string Scheduler::StartedAt() const {
  const Task* task = Find(running_);
  return task == nullptr ? "" : task->started_at;
}

std::optional<int64_t> Scheduler::Began(TaskId id) const {
  const Task* task = Find(id);
  return task == nullptr ? std::nullopt : std::optional(task->began);
}

const Scheduler::Outcome* Scheduler::OutcomeOf(TaskId id) const {
  const auto found = std::find_if(outcomes_.rbegin(), outcomes_.rend(),
                                  [id](const Outcome& outcome) { return outcome.id == id; });
  return found == outcomes_.rend() ? nullptr : &*found;
}

bool Scheduler::RunAgain(int64_t tick, TaskId id) {
  tick_ = tick;
  Task* task = Find(id);
  if (task == nullptr) {
    return false;
  }
  Resume(*task);
  return true;
}

void Scheduler::EndTick() {
  std::erase_if(tasks_, [](const std::unique_ptr<Task>& task) { return task->ended; });
}

void Scheduler::Run(int64_t tick) {
  tick_ = tick;
  for (bool progress = true; progress;) {
    progress = false;
    for (size_t i = 0; i < tasks_.size(); ++i) {  // tasks_ may grow meanwhile.
      Task& task = *tasks_[i];
      if (Ready(task)) {
        Resume(task);
        progress = true;
      }
    }
  }
  EndTick();
}

Scheduler::Task* Scheduler::Find(TaskId id) const {
  const auto found = std::find_if(
      tasks_.begin(), tasks_.end(),
      [id](const std::unique_ptr<Task>& task) { return task->id == id && !task->ended; });
  return found == tasks_.end() ? nullptr : found->get();
}

// The running task. Error: the caller is another coroutine of the script, which cannot wait for the
// task.
Scheduler::Task& Scheduler::CheckRunning(lua_State* lua, const char* function) const {
  Task* task = Find(running_);
  if (task == nullptr || task->thread != lua) {
    luaL_error(lua, "%s: only within main() or a function given to start, together or race",
               function);
  }
  if (lua_isyieldable(lua) == 0) {
    luaL_error(lua,
               "%s: cannot wait within a function that Lua's library calls, such as the comparison "
               "of table.sort; wait before or after it",
               function);
  }
  return *task;
}

bool Scheduler::Ready(const Task& task) const {
  if (task.ended || task.wake_tick > tick_) {
    return false;
  }
  if (task.until) {
    return task.until();
  }
  const auto alive = [this](TaskId id) { return Alive(id); };
  return task.join_any ? !std::all_of(task.joined.begin(), task.joined.end(), alive)
                       : std::none_of(task.joined.begin(), task.joined.end(), alive);
}

void Scheduler::Resume(Task& task) {
  task.joined.clear();
  task.join_any = false;
  task.until = nullptr;
  on_resume_(task.id);
  running_ = task.id;
  sandbox_.limits().Charge(Limits::kHookInterval);
  int results = 0;
  const int status = lua_resume(task.thread, nullptr, 0, &results);
  running_ = 0;
  if (status == LUA_YIELD) {
    lua_pop(task.thread, results);
    if (task.wake_tick <= tick_ && task.joined.empty() && !task.join_any && !task.until) {
      task.wake_tick = tick_ + 1;  // The script called coroutine.yield().
    }
    return;
  }
  Outcome outcome = {task.id, tick_, status != LUA_OK, {}};
  if (outcome.failed) {
    const LuaError error = sandbox_.Describe(task.thread, task.started_at);
    outcome.message = error.message;
    on_error_(error);
  }
  KeepOutcome(std::move(outcome));
  // A task that exceeded a limit ends here. Closing it, and the tasks after it, get the budget of a
  // new tick.
  Limits& limits = sandbox_.limits();
  const bool was_tripped = limits.tripped();
  if (was_tripped) {
    limits.Refill();
  }
  End(task);
  if (was_tripped || limits.tripped()) {
    lua_gc(sandbox_.lua(), LUA_GCCOLLECT);
    limits.Refill();
  }
}

void Scheduler::End(Task& task) {
  task.ended = true;
  lua_resetthread(task.thread);  // Runs pending close handlers.
  luaL_unref(sandbox_.lua(), LUA_REGISTRYINDEX, task.anchor);
}

}  // namespace lararium::drama
