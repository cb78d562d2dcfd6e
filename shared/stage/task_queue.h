#pragma once

// The tasks of all actors in the order of their tickets. Internal to shared/stage.

#include <utility>
#include <vector>

#include "shared/stage/task.h"

namespace lararium::stage {

// Plain values: a copy is a checkpoint.
class TaskQueue {
 public:
  explicit TaskQueue(size_t capacity) { tasks_.reserve(capacity); }

  // Appends a task and returns its new ticket. May drop old tasks that have ended.
  TaskId Add(const TaskRequest& request);
  // Drops a task that has ended; ignores others.
  void Forget(TaskId id);
  void Clear();

  // Sorted by id. References hold until the next Add, Forget or Clear.
  std::vector<Task>& tasks() { return tasks_; }
  const std::vector<Task>& tasks() const { return tasks_; }
  // Returns nullptr if there is no such task.
  const Task* Find(TaskId id) const;
  Task* Find(TaskId id) { return const_cast<Task*>(std::as_const(*this).Find(id)); }
  // The task for which the actor sits; nullptr: the actor does not sit.
  const Task* SeatOf(ActorId actor) const;
  Task* SeatOf(ActorId actor) { return const_cast<Task*>(std::as_const(*this).SeatOf(actor)); }
  bool Sits(ActorId actor) const { return SeatOf(actor) != nullptr; }
  // Whether the actor takes part in a running task.
  bool IsBusy(ActorId actor) const;
  // How many tasks other than `except` use the object.
  int UsersOf(ObjectId object, const Task& except) const;
  // Whether a task other than `except` has the approach place of the object.
  bool IsPlaceTaken(ObjectId object, int place, const Task& except) const;

 private:
  std::vector<Task> tasks_;  // Sorted by id.
  TaskId last_ = 0;
};

}  // namespace lararium::stage
