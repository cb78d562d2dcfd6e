#include "shared/stage/task_schedule.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "shared/stage/walking.h"
#include "shared/stage/world.h"

namespace lararium::stage {
namespace {

constexpr float kWaitBeforeLine = 0.4f;  // Seconds before a waiting actor joins the queue.
constexpr float kLineStep = 0.35f;  // Metres; an actor this near to its place in the queue stays.
constexpr float kBehindPlaces = 0.9f;   // Metres from the first place to the default queue.
constexpr float kMakeWayWithin = 0.5f;  // Metres from a goal; actors this near step aside.
constexpr float kStuckAfter = 1.5f;     // Seconds.
constexpr float kMakeWayFrom = 1.6f;    // Metres from the goal to the actor who comes.

bool SharesWith(const Task& a, const Task& b) {
  const auto has_actor = [](const Task& task, ActorId id) {
    return id && (task.actor == id || task.partner == id);
  };
  const auto has_object = [](const Task& task, ObjectId id) {
    return id && (task.object == id || task.target.object == id);
  };
  return has_actor(a, b.actor) || has_actor(a, b.partner) || has_object(a, b.object) ||
         has_object(a, b.target.object);
}

// Whether `other` holds something that `task` needs. Several tasks may use an object at once and
// put objects on it, but only one task can take, put, give or use it in the hand.
bool MustWaitFor(World& world, const Task& task, const Task& other) {
  const bool has_body = other.stage == TaskStage::kRunning;  // A lingering actor may go.
  if (has_body &&
      (task.actor == other.actor || task.actor == other.partner ||
       (task.partner && (task.partner == other.actor || task.partner == other.partner)))) {
    return true;
  }
  const auto as_a_whole = [&world](const Task& t, ObjectId object) {
    if (t.object != object) {
      return false;
    }
    return t.kind != TaskKind::kUse ||
           world.object(object).use().actions[static_cast<size_t>(t.action)].held;
  };
  const auto uses = [](const Task& t, ObjectId object) {
    return object && (t.object == object || t.target.object == object);
  };
  for (const ObjectId object : {task.object, task.target.object}) {
    if (uses(other, object) && (as_a_whole(task, object) || as_a_whole(other, object))) {
      return true;
    }
  }
  return false;
}

// Whether no earlier task of the actor waits.
bool IsFirstOf(const TaskQueue& queue, const Task& task) {
  return std::none_of(queue.tasks().begin(), queue.tasks().end(), [&](const Task& other) {
    return other.id < task.id && other.stage == TaskStage::kWaiting && other.actor == task.actor;
  });
}

}  // namespace

bool MayStart(World& world, const TaskQueue& queue, const Task& task) {
  return std::none_of(queue.tasks().begin(), queue.tasks().end(), [&](const Task& other) {
    if (other.stage == TaskStage::kWaiting) {
      return other.id < task.id && SharesWith(task, other);
    }
    return other.id != task.id && other.OccupiesPlace() && MustWaitFor(world, task, other);
  });
}

void WaitInLine(World& world, const TaskQueue& queue, const Task& task) {
  const ObjectId id = task.kind == TaskKind::kPut ? task.target.object : task.object;
  if (task.kind == TaskKind::kWalk || !id || task.waited < kWaitBeforeLine ||
      queue.IsBusy(task.actor) || !IsFirstOf(queue, task)) {
    return;
  }
  Actor& actor = world.actor(task.actor);
  const Object& object = world.object(id);
  if (!actor.state.visible || (object.use().places.empty() && !object.use().queue) ||
      object.use().carry) {
    return;
  }
  const auto before =
      std::count_if(queue.tasks().begin(), queue.tasks().end(), [&](const Task& other) {
        return other.id < task.id && other.stage == TaskStage::kWaiting &&
               other.actor != task.actor && (other.object == id || other.target.object == id);
      });
  ApproachPlace first;
  if (object.use().queue) {
    first = *object.use().queue;
  } else {
    first = object.use().places[0];
    first.position -= kBehindPlaces * Direction(first.heading);
  }
  const glm::vec2 place =
      InStage(object, first.position + static_cast<float>(before) * object.use().queue_step);
  const bool goes_there = actor.walk.phase != Walk::Phase::kNone;
  if (goes_there || glm::distance(actor.place(), place) < kLineStep) {
    return;
  }
  if (!BeginWalk(world, actor, place, HeadingInStage(object, first.heading), kWalkSpeed).ok()) {
    return;
  }
  if (glm::distance(actor.place(), actor.walk.goal) < kLineStep) {
    EndWalk(world, actor);  // The actor cannot get nearer.
  }
}

void MakeWay(World& world, const TaskQueue& queue, const Task& task) {
  const Actor& comes = world.actor(task.actor);
  const bool is_near = glm::distance(comes.place(), comes.walk.goal) < kMakeWayFrom;
  const bool is_stuck = comes.walk.stuck > kStuckAfter;
  if (comes.walk.phase != Walk::Phase::kGo || !(is_near || is_stuck)) {
    return;
  }
  const glm::vec2 goal = comes.walk.goal;
  for (const ActorId id : world.actor_ids) {
    Actor& other = world.actor(id);
    const bool stands_about = id != task.actor && other.state.visible && !other.led &&
                              other.walk.phase == Walk::Phase::kNone && !queue.IsBusy(id) &&
                              glm::distance(other.place(), goal) < kMakeWayWithin &&
                              !queue.Sits(id);
    if (!stands_about) {
      continue;
    }
    if (const auto aside = FindAside(world, id, is_near ? goal : comes.place())) {
      (void)BeginWalk(world, other, *aside, other.state.heading, kWalkSpeed).ok();
    }
  }
}

}  // namespace lararium::stage
