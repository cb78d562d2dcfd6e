#include "shared/stage/tasks.h"

#include <algorithm>
#include <cmath>

#include "shared/stage/task_schedule.h"
#include "shared/stage/walking.h"
#include "shared/stage/world.h"

namespace lararium::stage {
namespace {

constexpr float kMaxTaskSeconds = 24.0f * 3600.0f;

// The stroke of a walk is the arrival, that of take and give is the moment when the object changes
// hands, that of put is letting go, and that of an action is its course.
SyncPoint PointOf(World& world, const Task& task) {
  if (task.phase == TaskPhase::kApproach) {
    const Walk::Phase walk = world.actors.Find(task.actor)->walk.phase;
    const bool turns = walk == Walk::Phase::kNone || walk == Walk::Phase::kTurn;
    return task.kind == TaskKind::kWalk && walk == Walk::Phase::kFace ? SyncPoint::kRelax
           : task.kind == TaskKind::kWalk && !turns                   ? SyncPoint::kStrokeStart
                                                                      : SyncPoint::kStart;
  }
  switch (task.phase) {
    case TaskPhase::kAct: {
      const Object& object = world.object(task.object);
      const float duration = object.use().actions[static_cast<size_t>(task.action)].duration;
      return task.time < 0.5f * duration ? SyncPoint::kStrokeStart
             : task.time < duration      ? SyncPoint::kStroke
                                         : SyncPoint::kStrokeEnd;
    }
    case TaskPhase::kReach:
      return task.kind == TaskKind::kGive ? SyncPoint::kStrokeStart : SyncPoint::kReady;
    case TaskPhase::kLower:
    case TaskPhase::kSit:
      return SyncPoint::kStrokeStart;
    case TaskPhase::kBoth:
      return SyncPoint::kStroke;
    case TaskPhase::kCarry:
    case TaskPhase::kLetGo:
    case TaskPhase::kRise:
      return SyncPoint::kRelax;
    default:
      return SyncPoint::kReady;
  }
}

}  // namespace

// ---- requests ----

Status Tasks::CheckActor(ActorId actor) const {
  const Actor* found = world_.actors.Find(actor);
  if (found == nullptr) {
    return Status::Error("stage", "the actor has left the stage");
  }
  return found->led ? Status::Error(Quoted(found->name), "is led by a track") : Status();
}

Result<TaskId> Tasks::Begin(const TaskRequest& request) {
  LARARIUM_RETURN_IF_ERROR(CheckActor(request.actor));
  const auto open = std::count_if(queue_.tasks().begin(), queue_.tasks().end(),
                                  [](const Task& task) { return !task.is_over; });
  if (static_cast<size_t>(open) >= kMaxTasks) {
    return Status::Error("stage", "more than " + std::to_string(kMaxTasks) + " things to do",
                         "wait until some are done");
  }
  // Now, so that the actor does not keep a seat while the task waits.
  reservations_.GetsUpFor(request);
  return queue_.Add(request);
}

Result<TaskId> Tasks::Walk(ActorId actor,
                           glm::vec2 goal,
                           std::optional<float> heading,
                           float speed) {
  if (!(std::abs(goal.x) < 1e4f && std::abs(goal.y) < 1e4f && speed >= 0.0f && speed <= 10.0f)) {
    return Status::Error("walk", "the position or the speed is out of range");
  }
  return Begin(
      {.kind = TaskKind::kWalk, .actor = actor, .goal = goal, .heading = heading, .speed = speed});
}

Result<TaskId> Tasks::Turn(ActorId actor, float heading, float speed) {
  return Begin({.kind = TaskKind::kWalk,
                .actor = actor,
                .heading = heading,
                .speed = speed,
                .only_turns = true});
}

Result<TaskId> Tasks::Stand(ActorId actor) {
  LARARIUM_RETURN_IF_ERROR(CheckActor(actor));
  if (const Task* sits = queue_.SeatOf(actor)) {
    // Walk to where it stood before it sat down.
    const Object& seat = world_.object(sits->object);
    const ApproachPlace& place = seat.use().places[static_cast<size_t>(sits->place)];
    return Walk(actor, InStage(seat, place.position), std::nullopt, 0.0f);
  }
  return Walk(actor, world_.actor(actor).place(), std::nullopt, 0.0f);
}

Result<TaskId> Tasks::Use(ActorId actor, ObjectId object, std::string_view action, float seconds) {
  const Object* of = world_.objects.Find(object);
  if (of == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  const int found = of->use().FindAction(action);
  if (found < 0) {
    std::string known;
    for (const ObjectAction& one : of->use().actions) {
      known += (known.empty() ? "" : ", ") + one.name;
    }
    return Status::Error(Quoted(of->name), "has no action " + Quoted(std::string(action)),
                         known.empty() ? "it has none" : "it has " + known);
  }
  return Begin({.kind = TaskKind::kUse,
                .actor = actor,
                .object = object,
                .action = found,
                .seconds = std::clamp(seconds, 0.0f, kMaxTaskSeconds)});
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
  return Begin({.kind = TaskKind::kTake, .actor = actor, .object = object});
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
  return Begin({.kind = TaskKind::kPut, .actor = actor, .object = object, .target = target});
}

Result<TaskId> Tasks::Give(ActorId actor, ObjectId object, ActorId to) {
  if (world_.objects.Find(object) == nullptr) {
    return Status::Error("stage", "the object has left the stage");
  }
  LARARIUM_RETURN_IF_ERROR(CheckActor(to));
  if (actor == to) {
    return Status::Error(Quoted(world_.actor(to).name), "cannot give something to itself");
  }
  return Begin({.kind = TaskKind::kGive, .actor = actor, .partner = to, .object = object});
}

TaskReport Tasks::report(TaskId id) const {
  const Task* task = queue_.Find(id);
  if (task == nullptr) {
    return {};
  }
  if (task->is_over) {
    return {
        task->stage == TaskStage::kFailed ? TaskReport::State::kFailed : TaskReport::State::kDone,
        task->message, SyncPoint::kEnd, task->waited};
  }
  if (task->stage == TaskStage::kWaiting) {
    return {TaskReport::State::kWaiting, task->message, std::nullopt, task->waited};
  }
  return {TaskReport::State::kRunning, task->message, PointOf(world_, *task), task->waited};
}

void Tasks::Stop(TaskId id) {
  Task* task = queue_.Find(id);
  if (task == nullptr || task->is_over) {
    return;
  }
  if (task->stage == TaskStage::kRunning) {
    steps_.Abandon(*task);
  }
  task->Fail("was stopped");
}

void Tasks::StopAll(ActorId actor, std::string_view why) {
  for (Task& task : queue_.tasks()) {
    if (task.actor != actor && task.partner != actor) {
      continue;
    }
    if (task.stage == TaskStage::kRunning) {
      steps_.Abandon(task);
      task.Fail(std::string(why));
    } else if (task.stage == TaskStage::kWaiting) {
      task.Fail(std::string(why));
    } else if (task.stage == TaskStage::kLingering) {
      steps_.Abandon(task);
      task.stage = TaskStage::kDone;
    }
  }
}

std::optional<ObjectId> Tasks::ObjectOf(ActorId actor) const {
  for (const Task& task : queue_.tasks()) {
    const bool is_at_it = task.phase != TaskPhase::kApproach ||
                          world_.actors.Find(actor)->walk.phase != Walk::Phase::kGo;
    if (task.stage == TaskStage::kRunning && task.object && is_at_it &&
        (task.actor == actor || (task.partner == actor && task.phase != TaskPhase::kApproach))) {
      return task.object;
    }
  }
  return std::nullopt;
}

bool Tasks::any() const {
  return std::any_of(queue_.tasks().begin(), queue_.tasks().end(), [](const Task& task) {
    return task.stage == TaskStage::kWaiting || task.stage == TaskStage::kRunning;
  });
}

void Tasks::FailAll(std::string_view why) {
  for (Task& task : queue_.tasks()) {
    if (task.stage == TaskStage::kWaiting || task.stage == TaskStage::kRunning) {
      task.Fail(std::string(why));
    }
  }
}

void Tasks::Advance(float seconds) {
  for (Task& task : queue_.tasks()) {
    if (task.stage == TaskStage::kWaiting && MayStart(world_, queue_, task) &&
        reservations_.Reserve(task) && task.stage == TaskStage::kWaiting) {
      task.stage = TaskStage::kRunning;
    }
  }
  for (Task& task : queue_.tasks()) {
    if (task.stage == TaskStage::kRunning) {
      MakeWay(world_, queue_, task);
      task.time += seconds;
      steps_.Step(task, seconds);
    } else if (task.stage == TaskStage::kWaiting) {
      task.waited += seconds;
      WaitInLine(world_, queue_, task);
    }
  }
  // An actor without a task finishes its walk to a queue or aside.
  for (const ActorId id : world_.actor_ids) {
    Actor& actor = world_.actor(id);
    if (actor.walk.phase != Walk::Phase::kNone && !IsBusy(id) &&
        AdvanceWalk(world_, actor, seconds) == WalkResult::kBlocked) {
      EndWalk(world_, actor);
    }
  }
}

}  // namespace lararium::stage
