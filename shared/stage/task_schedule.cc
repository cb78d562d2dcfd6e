// Scheduling of tasks: which task may start, and what waiting actors do.

#include <algorithm>
#include <glm/geometric.hpp>

#include "shared/stage/tasks.h"
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

}  // namespace

// ---- scheduling ----

void Tasks::Advance(float seconds) {
  ScheduleReservations();
  for (Task& task : tasks_) {
    if (task.stage == Stage::kRunning) {
      MakeWay(task);
      task.time += seconds;
      Step(task, seconds);
    } else if (task.stage == Stage::kWaiting) {
      task.waited += seconds;
      WaitInLine(task, seconds);
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

bool Tasks::SharesWith(const Task& a, const Task& b) const {
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
bool Tasks::MustWaitFor(const Task& task, const Task& other) const {
  const bool has_body = other.stage == Stage::kRunning;  // A lingering actor may go.
  if (has_body &&
      (task.actor == other.actor || task.actor == other.partner ||
       (task.partner && (task.partner == other.actor || task.partner == other.partner)))) {
    return true;
  }
  const auto as_a_whole = [this](const Task& t, ObjectId object) {
    if (t.object != object) {
      return false;
    }
    return t.kind != Kind::kUse ||
           world_.object(object).use().actions[static_cast<size_t>(t.action)].held;
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

void Tasks::ScheduleReservations() {
  for (Task& task : tasks_) {
    if (task.stage != Stage::kWaiting) {
      continue;
    }
    bool must_wait = false;
    for (const Task& other : tasks_) {
      if (other.id == task.id) {
        continue;
      }
      if (other.stage == Stage::kWaiting) {
        must_wait = must_wait || (other.id < task.id && SharesWith(task, other));
      } else if (other.stage == Stage::kRunning || other.stage == Stage::kLingering) {
        must_wait = must_wait || MustWaitFor(task, other);
      }
    }
    if (!must_wait && Reserve(task) && task.stage == Stage::kWaiting) {
      task.stage = Stage::kRunning;
    }
  }
}

// ---- waiting ----

bool Tasks::IsFirstOf(const Task& task) const {
  return std::none_of(tasks_.begin(), tasks_.end(), [&](const Task& other) {
    return other.id < task.id && other.stage == Stage::kWaiting && other.actor == task.actor;
  });
}

// An actor who waits for an object with places stands in its queue.
void Tasks::WaitInLine(Task& task, float) {
  const ObjectId id = task.kind == Kind::kPut ? task.target.object : task.object;
  if (task.kind == Kind::kWalk || !id || task.waited < kWaitBeforeLine || IsBusy(task.actor) ||
      !IsFirstOf(task)) {
    return;
  }
  Actor& actor = world_.actor(task.actor);
  const Object& object = world_.object(id);
  if (!actor.state.visible || (object.use().places.empty() && !object.use().queue) ||
      object.use().carry) {
    return;
  }
  const auto before = std::count_if(tasks_.begin(), tasks_.end(), [&](const Task& other) {
    return other.id < task.id && other.stage == Stage::kWaiting && other.actor != task.actor &&
           (other.object == id || other.target.object == id);
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
  if (!BeginWalk(world_, actor, place, HeadingInStage(object, first.heading), kWalkSpeed).ok()) {
    return;
  }
  if (glm::distance(actor.place(), actor.walk.goal) < kLineStep) {
    EndWalk(world_, actor);  // The actor cannot get nearer.
  }
}

// Idle actors step aside if they stand where the task's actor has to stand or where it is stuck.
void Tasks::MakeWay(const Task& task) {
  const Actor& comes = world_.actor(task.actor);
  const bool is_near = glm::distance(comes.place(), comes.walk.goal) < kMakeWayFrom;
  const bool is_stuck = comes.walk.stuck > kStuckAfter;
  if (comes.walk.phase != Walk::Phase::kGo || !(is_near || is_stuck)) {
    return;
  }
  const glm::vec2 goal = comes.walk.goal;
  for (const ActorId id : world_.actor_ids) {
    Actor& other = world_.actor(id);
    const bool stands_about = id != task.actor && other.state.visible && !other.led &&
                              other.walk.phase == Walk::Phase::kNone && !IsBusy(id) &&
                              glm::distance(other.place(), goal) < kMakeWayWithin &&
                              std::none_of(tasks_.begin(), tasks_.end(), [id](const Task& t) {
                                return t.actor == id && t.stage == Stage::kLingering;
                              });
    if (!stands_about) {
      continue;
    }
    if (const auto aside = FindAside(world_, id, is_near ? goal : comes.place())) {
      (void)BeginWalk(world_, other, *aside, other.state.heading, kWalkSpeed).ok();
    }
  }
}

}  // namespace lararium::stage
