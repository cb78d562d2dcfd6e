#include "shared/stage/task_queue.h"

#include <algorithm>

namespace lararium::stage {
namespace {

constexpr size_t kKeptReports = 1024;

}  // namespace

TaskId TaskQueue::Add(const TaskRequest& request) {
  if (tasks_.size() >= kKeptReports) {  // The oldest reports are no longer needed.
    std::erase_if(tasks_, [](const Task& task) { return task.HasEnded(); });
  }
  tasks_.emplace_back(request).id = ++last_;
  return last_;
}

void TaskQueue::Forget(TaskId id) {
  const Task* task = Find(id);
  if (task != nullptr && task->HasEnded()) {
    tasks_.erase(tasks_.begin() + (task - tasks_.data()));
  }
}

void TaskQueue::Clear() {
  tasks_.clear();
  last_ = 0;
}

const Task* TaskQueue::Find(TaskId id) const {
  const auto found = std::lower_bound(tasks_.begin(), tasks_.end(), id,
                                      [](const Task& task, TaskId t) { return task.id < t; });
  return found == tasks_.end() || found->id != id ? nullptr : &*found;
}

const Task* TaskQueue::SeatOf(ActorId actor) const {
  const auto found = std::find_if(tasks_.begin(), tasks_.end(), [actor](const Task& task) {
    return task.actor == actor && task.stage == TaskStage::kLingering;
  });
  return found == tasks_.end() ? nullptr : &*found;
}

bool TaskQueue::IsBusy(ActorId actor) const {
  return std::any_of(tasks_.begin(), tasks_.end(), [actor](const Task& task) {
    return task.stage == TaskStage::kRunning && (task.actor == actor || task.partner == actor);
  });
}

int TaskQueue::UsersOf(ObjectId object, const Task& except) const {
  return static_cast<int>(std::count_if(tasks_.begin(), tasks_.end(), [&](const Task& task) {
    return task.id != except.id && task.kind == TaskKind::kUse && task.object == object &&
           task.OccupiesPlace();
  }));
}

bool TaskQueue::IsPlaceTaken(ObjectId object, int place, const Task& except) const {
  return std::any_of(tasks_.begin(), tasks_.end(), [&](const Task& task) {
    return task.id != except.id && task.place_of == object && task.place == place &&
           task.OccupiesPlace();
  });
}

}  // namespace lararium::stage
