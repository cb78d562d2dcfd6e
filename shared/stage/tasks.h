#pragma once

// Queue of the tasks of actors: walk, use, take, put, give. A task waits until everything it needs
// is free and then reserves it all at once. A waiting task holds nothing, so there can be no
// deadlock. Tickets are served in order: a task waits while an earlier waiting task shares a person
// or an object with it.

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "shared/core/status.h"
#include "shared/stage/sync_point.h"
#include "shared/stage/task_reservations.h"

namespace lararium::stage {

struct TaskReport {
  enum class State : uint8_t {
    kUnknown,  // Never created, or forgotten.
    kWaiting,
    kRunning,
    kDone,
    kFailed,
  };
  State state = State::kUnknown;
  // For the author of the drama: why the task failed, or how the result differs from the request.
  std::string_view message;
  std::optional<SyncPoint> reached;  // The latest point that was reached; none: the task waits.
  float waited = 0.0f;               // Seconds in state kWaiting.

  bool over() const { return state == State::kDone || state == State::kFailed; }
};

class Tasks {
 public:
  static constexpr size_t kMaxTasks = 256;  // Limit of tasks that are not over.

  // Borrows world.
  explicit Tasks(World& world) : world_(world) {}
  Tasks(const Tasks&) = delete;
  Tasks& operator=(const Tasks&) = delete;

  // Each call appends a task to the queue of an actor. It returns an error only if the task can
  // never succeed: the actor is led by a track, the object has no such action. Obstacles that
  // appear when its turn comes are reported by report().
  //
  // speed: m/s; 0: a comfortable speed.
  Result<TaskId> Walk(ActorId actor, glm::vec2 goal, std::optional<float> heading, float speed);
  // speed: rad/s; 0: a natural speed.
  Result<TaskId> Turn(ActorId actor, float heading, float speed);
  // seconds: minimum duration of the action.
  Result<TaskId> Use(ActorId actor, ObjectId object, std::string_view action, float seconds);
  Result<TaskId> Take(ActorId actor, ObjectId object);
  Result<TaskId> Put(ActorId actor, ObjectId object, const PutTarget& target);
  Result<TaskId> Give(ActorId actor, ObjectId object, ActorId to);
  // The actor gets up if it sits.
  Result<TaskId> Stand(ActorId actor);

  TaskReport report(TaskId id) const;
  // Ends a task where it is; hands let go of objects that they do not hold. Ignores stale ids.
  void Stop(TaskId id);
  // Stops all tasks of an actor, and it no longer sits. `why` becomes the message of the tasks.
  void StopAll(ActorId actor, std::string_view why);
  // Drops the report of a task that is over.
  void Forget(TaskId id) { queue_.Forget(id); }

  // Whether a task of the actor is running, whether the actor sits, and which object it handles.
  bool IsBusy(ActorId actor) const { return queue_.IsBusy(actor); }
  bool Sits(ActorId actor) const { return queue_.Sits(actor); }
  std::optional<ObjectId> ObjectOf(ActorId actor) const;

  // Whether any task is waiting or running.
  bool any() const;
  void FailAll(std::string_view why);
  // One tick.
  void Advance(float seconds);
  void Reset() { queue_.Clear(); }

  // The complete state, to return to later.
  using State = TaskQueue;
  std::shared_ptr<const State> Save() const { return std::make_shared<State>(queue_); }
  void Restore(const State& state) { queue_ = state; }  // Keeps the capacity.

 private:
  Result<TaskId> Begin(const TaskRequest& request);
  Status CheckActor(ActorId actor) const;

  World& world_;
  TaskQueue queue_{2 * kMaxTasks};
  TaskSteps steps_{world_, queue_};
  TaskReservations reservations_{world_, queue_, steps_};
};

}  // namespace lararium::stage
