// Creating, reporting and stopping tasks. task_schedule.cc decides which task may start,
// task_reservations.cc reserves what it needs, and task_steps.cc executes it.

#include "shared/stage/tasks.h"

#include <algorithm>
#include <cmath>

#include "shared/stage/walking.h"
#include "shared/stage/world.h"

namespace lararium::stage {
namespace {

constexpr size_t kKeptReports = 1024;
constexpr float kMaxTaskSeconds = 24.0f * 3600.0f;

}  // namespace

// ---- requests ----

Status Tasks::CheckActor(ActorId actor) const {
  const Actor* found = world_.actors.Find(actor);
  if (found == nullptr) {
    return Status::Error("stage", "the actor has left the stage");
  }
  return found->led ? Status::Error(Quoted(found->name), "is led by a track") : Status();
}

Result<TaskId> Tasks::Begin(Task task) {
  LARARIUM_RETURN_IF_ERROR(CheckActor(task.actor));
  const auto open =
      std::count_if(tasks_.begin(), tasks_.end(), [](const Task& t) { return !t.is_over; });
  if (static_cast<size_t>(open) >= kMaxTasks) {
    return Status::Error("stage", "more than " + std::to_string(kMaxTasks) + " things to do",
                         "wait until some are done");
  }
  if (tasks_.size() >= kKeptReports) {  // The oldest reports are no longer needed.
    std::erase_if(
        tasks_, [](const Task& t) { return t.stage == Stage::kDone || t.stage == Stage::kFailed; });
  }
  GetsUpFor(task);  // Now, so that the actor does not keep a seat while the task waits.
  task.id = ++last_;
  tasks_.push_back(std::move(task));
  return last_;
}

Result<TaskId> Tasks::Walk(ActorId actor,
                           glm::vec2 goal,
                           std::optional<float> heading,
                           float speed) {
  if (!(std::abs(goal.x) < 1e4f && std::abs(goal.y) < 1e4f && speed >= 0.0f && speed <= 10.0f)) {
    return Status::Error("walk", "the position or the speed is out of range");
  }
  Task task;
  task.kind = Kind::kWalk;
  task.actor = actor;
  task.goal = goal;
  task.heading = heading;
  task.speed = speed;
  return Begin(std::move(task));
}

Result<TaskId> Tasks::Turn(ActorId actor, float heading, float speed) {
  Task task;
  task.kind = Kind::kWalk;
  task.actor = actor;
  task.heading = heading;
  task.speed = speed;
  task.only_turns = true;
  return Begin(std::move(task));
}

Result<TaskId> Tasks::Stand(ActorId actor) {
  LARARIUM_RETURN_IF_ERROR(CheckActor(actor));
  const Actor& who = world_.actor(actor);
  for (const Task& other : tasks_) {
    if (other.actor == actor && other.stage == Stage::kLingering) {
      // Walk to where it stood before it sat down.
      const Object& seat = world_.object(other.object);
      const ApproachPlace& place = seat.use().places[static_cast<size_t>(other.place)];
      return Walk(actor, InStage(seat, place.position), std::nullopt, 0.0f);
    }
  }
  return Walk(actor, who.place(), std::nullopt, 0.0f);
}

Result<TaskId> Tasks::Use(ActorId actor, ObjectId object, std::string_view action, float seconds) {
  const Object* of = world_.objects.Find(object);
  if (of == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  Task task;
  task.kind = Kind::kUse;
  task.actor = actor;
  task.object = object;
  task.action = of->use().FindAction(action);
  task.seconds = std::clamp(seconds, 0.0f, kMaxTaskSeconds);
  if (task.action < 0) {
    std::string known;
    for (const ObjectAction& one : of->use().actions) {
      known += (known.empty() ? "" : ", ") + one.name;
    }
    return Status::Error(Quoted(of->name), "has no action " + Quoted(std::string(action)),
                         known.empty() ? "it has none" : "it has " + known);
  }
  return Begin(std::move(task));
}

Result<TaskId> Tasks::Take(ActorId actor, ObjectId object) {
  const Object* of = world_.objects.Find(object);
  if (of == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  if (!of->use().carry) {
    return Status::Error(Quoted(of->name), "cannot be carried",
                         "give it \"carry\" in its object.json");
  }
  Task task;
  task.kind = Kind::kTake;
  task.actor = actor;
  task.object = object;
  return Begin(std::move(task));
}

Result<TaskId> Tasks::Put(ActorId actor, ObjectId object, const PutTarget& target) {
  if (world_.objects.Find(object) == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  const Object* on = world_.objects.Find(target.object);
  if (target.object && on == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  if (on != nullptr &&
      (on->use().surfaces.empty() ||
       (target.surface >= 0 && static_cast<size_t>(target.surface) >= on->use().surfaces.size()))) {
    return Status::Error(Quoted(on->name), "has no such surface to put things on",
                         "give it \"surfaces\" in its object.json");
  }
  Task task;
  task.kind = Kind::kPut;
  task.actor = actor;
  task.object = object;
  task.target = target;
  return Begin(std::move(task));
}

Result<TaskId> Tasks::Give(ActorId actor, ObjectId object, ActorId to) {
  if (world_.objects.Find(object) == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  LARARIUM_RETURN_IF_ERROR(CheckActor(to));
  if (actor == to) {
    return Status::Error(Quoted(world_.actor(to).name), "cannot give something to itself");
  }
  Task task;
  task.kind = Kind::kGive;
  task.actor = actor;
  task.partner = to;
  task.object = object;
  return Begin(std::move(task));
}

const Tasks::Task* Tasks::Find(TaskId id) const {
  const auto found = std::lower_bound(tasks_.begin(), tasks_.end(), id,
                                      [](const Task& task, TaskId t) { return task.id < t; });
  return found == tasks_.end() || found->id != id ? nullptr : &*found;
}

TaskReport Tasks::report(TaskId id) const {
  const Task* task = Find(id);
  if (task == nullptr) {
    return {};
  }
  if (task->is_over) {
    return {task->stage == Stage::kFailed ? TaskReport::State::kFailed : TaskReport::State::kDone,
            task->message, SyncPoint::kEnd, task->waited};
  }
  if (task->stage == Stage::kWaiting) {
    return {TaskReport::State::kWaiting, task->message, std::nullopt, task->waited};
  }
  return {TaskReport::State::kRunning, task->message, PointOf(*task), task->waited};
}

// The stroke of a walk is the arrival, that of take and give is the moment when the object changes
// hands, that of put is letting go, and that of an action is its course.
SyncPoint Tasks::PointOf(const Task& task) const {
  if (task.phase == Phase::kApproach) {
    const Walk::Phase walk = world_.actors.Find(task.actor)->walk.phase;
    const bool turns = walk == Walk::Phase::kNone || walk == Walk::Phase::kTurn;
    return task.kind == Kind::kWalk && walk == Walk::Phase::kFace ? SyncPoint::kRelax
           : task.kind == Kind::kWalk && !turns                   ? SyncPoint::kStrokeStart
                                                                  : SyncPoint::kStart;
  }
  switch (task.phase) {
    case Phase::kAct: {
      const Object& object = world_.object(task.object);
      const float duration = object.use().actions[static_cast<size_t>(task.action)].duration;
      return task.time < 0.5f * duration ? SyncPoint::kStrokeStart
             : task.time < duration      ? SyncPoint::kStroke
                                         : SyncPoint::kStrokeEnd;
    }
    case Phase::kReach:
      return task.kind == Kind::kGive ? SyncPoint::kStrokeStart : SyncPoint::kReady;
    case Phase::kLower:
    case Phase::kSit:
      return SyncPoint::kStrokeStart;
    case Phase::kBoth:
      return SyncPoint::kStroke;
    case Phase::kCarry:
    case Phase::kLetGo:
    case Phase::kRise:
      return SyncPoint::kRelax;
    default:
      return SyncPoint::kReady;
  }
}

void Tasks::Stop(TaskId id) {
  Task* task = const_cast<Task*>(Find(id));
  if (task == nullptr || task->is_over) {
    return;
  }
  if (task->stage == Stage::kRunning) {
    Abandon(*task);
  }
  Fail(*task, "was stopped");
}

void Tasks::StopAll(ActorId actor, std::string_view why) {
  for (Task& task : tasks_) {
    if (task.actor != actor && task.partner != actor) {
      continue;
    }
    if (task.stage == Stage::kRunning) {
      Abandon(task);
      Fail(task, std::string(why));
    } else if (task.stage == Stage::kWaiting) {
      Fail(task, std::string(why));
    } else if (task.stage == Stage::kLingering) {
      Abandon(task);
      task.stage = Stage::kDone;
    }
  }
}

void Tasks::Forget(TaskId id) {
  const Task* task = Find(id);
  if (task != nullptr && (task->stage == Stage::kDone || task->stage == Stage::kFailed)) {
    tasks_.erase(tasks_.begin() + (task - tasks_.data()));
  }
}

bool Tasks::IsBusy(ActorId actor) const {
  return std::any_of(tasks_.begin(), tasks_.end(), [actor](const Task& task) {
    return task.stage == Stage::kRunning && (task.actor == actor || task.partner == actor);
  });
}

std::optional<ObjectId> Tasks::ObjectOf(ActorId actor) const {
  for (const Task& task : tasks_) {
    const bool is_at_it =
        task.phase != Phase::kApproach || world_.actors.Find(actor)->walk.phase != Walk::Phase::kGo;
    if (task.stage == Stage::kRunning && task.object && is_at_it &&
        (task.actor == actor || (task.partner == actor && task.phase != Phase::kApproach))) {
      return task.object;
    }
  }
  return std::nullopt;
}

bool Tasks::any() const {
  return std::any_of(tasks_.begin(), tasks_.end(), [](const Task& task) {
    return task.stage == Stage::kWaiting || task.stage == Stage::kRunning;
  });
}

void Tasks::FailAll(std::string_view why) {
  for (Task& task : tasks_) {
    if (task.stage == Stage::kWaiting || task.stage == Stage::kRunning) {
      Fail(task, std::string(why));
    }
  }
}

void Tasks::Reset() {
  tasks_.clear();
  last_ = 0;
}

struct Tasks::State {
  std::vector<Task> tasks;
  TaskId last = 0;
};

std::shared_ptr<const Tasks::State> Tasks::Save() const {
  return std::make_shared<State>(State{tasks_, last_});
}

void Tasks::Restore(const State& state) {
  tasks_.assign(state.tasks.begin(), state.tasks.end());  // Keeps the capacity.
  last_ = state.last;
}

}  // namespace lararium::stage
