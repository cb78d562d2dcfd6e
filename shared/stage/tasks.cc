// Tickets and turns; task_steps.cc has what tasks do.

#include "shared/stage/tasks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "shared/stage/hands.h"
#include "shared/stage/walking.h"
#include "shared/stage/world.h"

namespace lararium::stage {
namespace {

constexpr float kWaitBeforeLine = 0.4f;  // seconds
constexpr float kLineStep = 0.35f;       // metres: who stands this near stands in line
constexpr float kBehindPlaces = 0.9f;    // metres, of the default queue
constexpr float kReachNearest = 0.42f;   // metres from what hands reach for, of 1.7 m people
constexpr float kReachFurthest = 0.85f;  // leaning over a counter
constexpr float kNearerByArms = 0.25f;   // metres, for each 1.7 m of height that is missing
constexpr float kTwistAllowed = 0.5f;    // radians that hands may twist
constexpr float kGiveNearest = 0.75f;    // metres between two people
constexpr float kGiveFurthest = 1.05f;
constexpr float kBeforeSeat = 0.8f;     // radians aside, of who gives to somebody who sits
constexpr float kMakeWayWithin = 0.5f;  // metres
constexpr float kStuckAfter = 1.5f;     // seconds
constexpr float kMakeWayFrom = 1.6f;    // metres, of who comes
constexpr size_t kKeptReports = 1024;
constexpr float kMaxSeconds = 24.0f * 3600.0f;

std::string Quoted(const std::string& name) { return "'" + name + "'"; }

glm::vec2 OnFloor(const glm::vec3& point) { return {point.x, point.z}; }

glm::vec2 InStage(const Object& object, glm::vec2 point) {
  return OnFloor(object.state.stage_from_object * glm::vec3(point.x, 0.0f, point.y));
}

float HeadingInStage(const Object& object, float heading) {
  const glm::vec2 direction = Direction(heading);
  return HeadingOf(
      OnFloor(object.state.stage_from_object.rotation * glm::vec3(direction.x, 0.0f, direction.y)));
}

// That of its clip of walking; else by its size (Froude).
float ComfortableSpeed(const Actor& actor) {
  if (actor.walk_clip >= 0) {
    const human::Clip& clip = actor.human().clips[static_cast<size_t>(actor.walk_clip)];
    return clip.stride / clip.duration;
  }
  return kWalkSpeed * std::sqrt(actor.eye_height() / 1.58f);
}

}  // namespace

// ---- asking ----

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
  if (tasks_.size() >= kKeptReports) {  // nobody asks for the oldest any more
    std::erase_if(
        tasks_, [](const Task& t) { return t.stage == Stage::kDone || t.stage == Stage::kFailed; });
  }
  GetsUpFor(task);  // so that nobody keeps a seat while waiting
  task.id = ++last_;
  tasks_.push_back(std::move(task));
  return last_;
}

Result<TaskId> Tasks::Walk(ActorId actor,
                           glm::vec2 goal,
                           std::optional<float> heading,
                           float speed) {
  if (!(std::abs(goal.x) < 1e4f && std::abs(goal.y) < 1e4f && speed >= 0.0f && speed <= 10.0f)) {
    return Status::Error("walk", "the place or the speed is not a possible one");
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
      // To where it stood before it sat down.
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
  task.seconds = std::clamp(seconds, 0.0f, kMaxSeconds);
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

// ---- sitting ----

Tasks::Task* Tasks::SeatOf(ActorId actor) {
  const auto found = std::find_if(tasks_.begin(), tasks_.end(), [actor](const Task& task) {
    return task.actor == actor && task.stage == Stage::kLingering;
  });
  return found == tasks_.end() ? nullptr : &*found;
}

bool Tasks::Sits(ActorId actor) const { return const_cast<Tasks*>(this)->SeatOf(actor) != nullptr; }

bool Tasks::CanReachSitting(ActorId id, const glm::vec3& point) const {
  constexpr float kFurthest = 0.78f;                 // metres, of somebody 1.7 m tall
  constexpr float kLowest = 0.70f, kHighest = 1.7f;  // as if upright
  constexpr float kAside = 1.1f;                     // radians
  const Actor& actor = world_.actor(id);
  Pose at = StageFromUpperBody(actor).Inverse() * Pose{point};
  at.position /= ScaledTo(actor, {{1.0f, 0.0f, 0.0f}}).position.x;
  const glm::vec2 way = OnFloor(at.position);
  return glm::length(way) < kFurthest && std::abs(HeadingOf(way)) < kAside &&
         at.position.y > kLowest && at.position.y < kHighest;
}

bool Tasks::IsDoneSitting(const Task& task) const {
  const Object* object = world_.objects.Find(task.object);
  switch (task.kind) {
    case Kind::kWalk:
      return false;
    case Kind::kUse:
      return object->use().actions[static_cast<size_t>(task.action)].held;
    case Kind::kTake:
      return object->state.holder == task.actor ||
             CanReachSitting(task.actor, object->state.stage_from_object.position);
    case Kind::kPut: {
      const Object* on = world_.objects.Find(task.target.object);
      if (on == nullptr) {
        return false;
      }
      for (size_t s = 0; s < on->use().surfaces.size(); ++s) {
        for (size_t i = 0; i < on->use().surfaces[s].spots.size(); ++i) {
          if (IsSpotFor(task, static_cast<int>(s), static_cast<int>(i)) &&
              !IsOccupied(world_, task.target.object, static_cast<int>(s), static_cast<int>(i))) {
            return true;
          }
        }
      }
      return false;
    }
    case Kind::kGive:
      return glm::distance(world_.actor(task.actor).place(), world_.actor(task.partner).place()) <
             kGiveFurthest;
  }
  return false;
}

// Of the surface that was asked for, and in reach of who sits.
bool Tasks::IsSpotFor(const Task& task, int surface, int spot) const {
  if (task.target.surface >= 0 && task.target.surface != surface) {
    return false;
  }
  const Object& on = world_.object(task.target.object);
  return !Sits(task.actor) ||
         CanReachSitting(task.actor, (on.state.stage_from_object *
                                      ObjectFromSpot(*on.model, on.state.joints, surface, spot))
                                         .position);
}

bool Tasks::GetsUpFor(const Task& task) {
  Task* seat = SeatOf(task.actor);
  if (seat == nullptr || IsDoneSitting(task)) {
    return false;
  }
  seat->stage = Stage::kRunning;
  Enter(*seat, Phase::kRise);
  return true;
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

// What matters of each: of a walk the arrival, of taking and giving the moment at which
// hands change, of putting that of letting go, of an action its course.
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
  tasks_.assign(state.tasks.begin(), state.tasks.end());  // keeps its room
  last_ = state.last;
}

// ---- turns ----

void Tasks::Advance(float seconds) {
  GrantTurns();
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
  // Who has no task finishes what it walks for others.
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

// Whether what the other one has keeps this one from having all it needs. Several may
// use an object at once, and put things on it, but only one has it as a whole.
bool Tasks::MustWaitFor(const Task& task, const Task& other) const {
  const bool has_body = other.stage == Stage::kRunning;  // who lingers is free to go
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

void Tasks::GrantTurns() {
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
    if (!must_wait && Grant(task) && task.stage == Stage::kWaiting) {
      task.stage = Stage::kRunning;
    }
  }
}

bool Tasks::Grant(Task& task) {
  const Actor& actor = world_.actor(task.actor);
  if (!actor.state.visible) {
    Fail(task, Quoted(actor.name) + " is not on the stage; place it first");
    return true;
  }
  const bool gets_up = actor.state.performance.sitting.amount > 0.0f && !Sits(task.actor);
  if (gets_up || GetsUpFor(task)) {
    return false;
  }
  switch (task.kind) {
    case Kind::kWalk:
      if (task.only_turns) {
        stage::Walk& walk = world_.actor(task.actor).walk;
        EndWalk(world_, world_.actor(task.actor));
        walk = {};
        walk.phase = Walk::Phase::kFace;
        walk.heading = task.heading;
        walk.turn_speed = task.speed;
        Enter(task, Phase::kApproach);
        return true;
      }
      return Approach(task, task.goal, task.heading);
    case Kind::kUse:
      return GrantUse(task);
    case Kind::kTake:
      return GrantTake(task);
    case Kind::kPut:
      return GrantPut(task);
    case Kind::kGive:
      return GrantGive(task);
  }
  return true;
}

bool Tasks::Approach(Task& task, glm::vec2 goal, std::optional<float> heading) {
  Actor& actor = world_.actor(task.actor);
  const float speed = task.speed > 0.0f ? task.speed : ComfortableSpeed(actor);
  const Status status = BeginWalk(world_, actor, goal, heading, speed);
  if (!status.ok()) {
    Fail(task, status.message());
    return true;
  }
  if (!actor.walk.complete) {
    const auto centimetres = [](float x) {
      return std::to_string(std::round(x * 100.0f) / 100.0f).substr(0, x < 0.0f ? 5 : 4);
    };
    task.message = Quoted(actor.name) +
                   " cannot get there; the nearest place is x = " + centimetres(actor.walk.goal.x) +
                   ", z = " + centimetres(actor.walk.goal.y);
    if (task.kind != Kind::kWalk) {
      EndWalk(world_, actor);
      Fail(task, task.message);
      return true;
    }
  }
  Enter(task, Phase::kApproach);
  return true;
}

bool Tasks::ApproachNear(Task& task, const glm::vec3& point, std::optional<float> facing) {
  if (Sits(task.actor)) {
    Arrive(task);
    return true;
  }
  const Actor& actor = world_.actor(task.actor);
  const glm::vec2 on_floor = OnFloor(point);
  const float distance = glm::distance(actor.place(), on_floor);
  const float scale = ScaledTo(actor, {{1.0f, 0.0f, 0.0f}}).position.x;
  StandWish wish = {on_floor, scale * kReachNearest, scale * kReachFurthest, facing};
  std::optional<glm::vec2> stand;
  const bool is_well_turned =
      !facing ||
      std::abs(TurnBetween(*facing, HeadingOf(on_floor - actor.place()))) < kTwistAllowed;
  if (distance >= 0.8f * wish.nearest && distance <= wish.furthest && is_well_turned) {
    stand = actor.place();  // in reach from here
  } else {
    stand = FindStand(world_, task.actor, wish);
  }
  if (!stand) {
    wish.among_others = true;  // they make way, or go on
    stand = FindStand(world_, task.actor, wish);
  }
  if (!stand) {
    Fail(task, Quoted(actor.name) + " cannot get near enough to " +
                   Quoted(world_.object(task.object).name));
    return true;
  }
  return Approach(task, *stand, HeadingOf(on_floor - *stand));
}

bool Tasks::ApproachPlaceOf(Task& task, ObjectId id, int place) {
  if (Sits(task.actor)) {
    Arrive(task);
    return true;
  }
  if (IsPlaceTaken(id, place, task)) {
    return false;
  }
  task.place_of = id;
  task.place = place;
  const Object& object = world_.object(id);
  const ApproachPlace& at = object.use().places[static_cast<size_t>(place)];
  // Places are those of somebody 1.7 m tall: who has shorter arms stands nearer.
  const float scale = ScaledTo(world_.actor(task.actor), {{1.0f, 0.0f, 0.0f}}).position.x;
  const glm::vec2 nearer = kNearerByArms * std::max(0.0f, 1.0f - scale) * Direction(at.heading);
  return Approach(task, InStage(object, at.position + nearer), HeadingInStage(object, at.heading));
}

int Tasks::UsersOf(ObjectId object, const Task& except) const {
  return static_cast<int>(std::count_if(tasks_.begin(), tasks_.end(), [&](const Task& task) {
    return task.id != except.id && task.kind == Kind::kUse && task.object == object &&
           (task.stage == Stage::kRunning || task.stage == Stage::kLingering);
  }));
}

bool Tasks::IsPlaceTaken(ObjectId object, int place, const Task& except) const {
  return std::any_of(tasks_.begin(), tasks_.end(), [&](const Task& task) {
    return task.id != except.id && task.place_of == object && task.place == place &&
           (task.stage == Stage::kRunning || task.stage == Stage::kLingering);
  });
}

bool Tasks::GrantUse(Task& task) {
  const Object& object = world_.object(task.object);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  const Actor& actor = world_.actor(task.actor);
  const auto what = [&] {
    return Quoted(actor.name) + " cannot '" + action.name + "' " + Quoted(object.name);
  };
  if (!action.held && UsersOf(task.object, task) >= object.use().capacity) {
    return false;
  }
  if ((action.from >> object.state.state & 1u) == 0) {
    Fail(task, what() + ": it is " +
                   Quoted(object.use().states[static_cast<size_t>(object.state.state)]));
    return true;
  }
  if (action.held != (object.state.holder == task.actor)) {
    Fail(task, what() + (action.held ? ": it does not hold it" : ": it holds it in its hands"));
    return true;
  }
  if (!action.held && object.state.holder) {
    Fail(task,
         what() + ": it is in the hands of " + Quoted(world_.actor(object.state.holder).name));
    return true;
  }
  const auto hands = ChooseHands(world_, task.actor, task.object, action.hands);
  if (!hands) {
    Fail(task, what() + ": its hands are full");
    return true;
  }
  task.hands = *hands;
  if (action.held) {
    Enter(task, Phase::kReach);
    return true;
  }
  float nearest = 1e9f;
  int chosen = -1;
  bool any = false;
  for (size_t i = 0; i < object.use().places.size(); ++i) {
    if ((action.places >> i & 1u) == 0) {
      continue;
    }
    any = true;
    if (IsPlaceTaken(task.object, static_cast<int>(i), task)) {
      continue;
    }
    const glm::vec2 place = InStage(object, object.use().places[i].position);
    const auto way = world_.navigation->FindWay(actor.place(), place);
    const float length = way && way->complete ? way->length : 1e6f;
    if (length < nearest) {
      nearest = length;
      chosen = static_cast<int>(i);
    }
  }
  if (chosen < 0 && any) {
    return false;
  }
  return ApproachPlaceOf(task, task.object, chosen);
}

bool Tasks::GrantTake(Task& task) {
  const Object& object = world_.object(task.object);
  const Actor& actor = world_.actor(task.actor);
  if (object.state.holder == task.actor) {
    Finish(task);
    return true;
  }
  const auto what = [&] { return Quoted(actor.name) + " cannot take " + Quoted(object.name); };
  if (object.state.holder) {
    Fail(task, what() + ": it is in the hands of " +
                   Quoted(world_.actor(object.state.holder).name) +
                   "; let them give it or put it down");
    return true;
  }
  const auto hands = ChooseHands(world_, task.actor, task.object, object.use().carry->hands);
  if (!hands) {
    Fail(task, what() + ": its hands are full");
    return true;
  }
  task.hands = *hands;
  const Support& support = object.state.support;
  if (support.object) {
    const Object& base = world_.object(support.object);
    const int place = base.use()
                          .surfaces[static_cast<size_t>(support.surface)]
                          .spots[static_cast<size_t>(support.spot)]
                          .place;
    if (place >= 0) {
      return ApproachPlaceOf(task, support.object, place);
    }
  }
  return ApproachNear(
      task, object.state.stage_from_object.position,
      HeadingOf(object.state.stage_from_object.rotation) - CarriedTurn(object.use()));
}

bool Tasks::GrantPut(Task& task) {
  const Object& object = world_.object(task.object);
  const Actor& actor = world_.actor(task.actor);
  const auto what = [&] {
    return Quoted(actor.name) + " cannot put " + Quoted(object.name) + " there";
  };
  if (object.state.holder != task.actor) {
    Fail(task, what() + ": it does not hold it");
    return true;
  }
  task.hands = object.state.hands;
  if (!task.target.object) {
    std::optional<float> facing;
    if (task.target.heading) {
      facing = *task.target.heading - CarriedTurn(object.use());
    }
    return ApproachNear(task, {task.target.place.x, 0.0f, task.target.place.y}, facing);
  }
  if (RestsOn(world_, task.target.object, task.object)) {
    Fail(task, what() + ": that stands on what it holds");
    return true;
  }
  const Object& on = world_.object(task.target.object);
  float nearest = 1e9f;
  int surface = -1;
  int spot = -1;
  bool may_become_free = false;
  for (size_t s = 0; s < on.use().surfaces.size(); ++s) {
    for (size_t i = 0; i < on.use().surfaces[s].spots.size(); ++i) {
      const int at_s = static_cast<int>(s);
      const int at_i = static_cast<int>(i);
      if (!IsSpotFor(task, at_s, at_i)) {
        continue;
      }
      const bool is_wanted = std::any_of(tasks_.begin(), tasks_.end(), [&](const Task& other) {
        return other.id != task.id && other.kind == Kind::kPut && other.stage == Stage::kRunning &&
               other.target.object == task.target.object && other.target.surface == at_s &&
               other.spot == at_i;
      });
      if (is_wanted || IsOccupied(world_, task.target.object, at_s, at_i)) {
        continue;
      }
      const int place = on.use().surfaces[s].spots[i].place;
      if (place >= 0 && IsPlaceTaken(task.target.object, place, task)) {
        may_become_free = true;
        continue;
      }
      const glm::vec3 point = on.state.stage_from_object *
                              ObjectFromSpot(*on.model, on.state.joints, at_s, at_i).position;
      const float distance = glm::distance(OnFloor(point), actor.place());
      if (distance < nearest) {
        nearest = distance;
        surface = at_s;
        spot = at_i;
      }
    }
  }
  // A spot that somebody is clearing will be free.
  for (const Task& other : tasks_) {
    if (other.id != task.id && other.kind == Kind::kTake && other.stage == Stage::kRunning &&
        world_.object(other.object).state.support.object == task.target.object) {
      may_become_free = true;
    }
  }
  if (spot < 0) {
    if (may_become_free) {
      return false;
    }
    Fail(task, what() + ": there is no free spot on " + Quoted(on.name));
    return true;
  }
  task.target.surface = surface;
  task.spot = spot;
  const Spot& chosen =
      on.use().surfaces[static_cast<size_t>(surface)].spots[static_cast<size_t>(spot)];
  if (chosen.place >= 0) {
    return ApproachPlaceOf(task, task.target.object, chosen.place);
  }
  return ApproachNear(task,
                      on.state.stage_from_object *
                          ObjectFromSpot(*on.model, on.state.joints, surface, spot).position,
                      std::nullopt);
}

bool Tasks::GrantGive(Task& task) {
  const Object& object = world_.object(task.object);
  const Actor& actor = world_.actor(task.actor);
  const Actor& partner = world_.actor(task.partner);
  const auto what = [&] {
    return Quoted(actor.name) + " cannot give " + Quoted(object.name) + " to " +
           Quoted(partner.name);
  };
  if (object.state.holder != task.actor) {
    Fail(task, what() + ": it does not hold it");
    return true;
  }
  if (!partner.state.visible) {
    Fail(task, what() + ", who is not on the stage");
    return true;
  }
  task.hands = object.state.hands;
  if (Sits(task.actor)) {
    Arrive(task);
    return true;
  }
  // Who sits takes it from the front.
  const glm::vec2 to = OnFloor(StageFromUpperBody(partner).position);
  const float distance = glm::distance(actor.place(), to);
  std::optional<float> facing;
  if (Sits(task.partner)) {
    facing = partner.state.heading + std::numbers::pi_v<float>;
  }
  const bool is_before =
      !facing || std::abs(TurnBetween(*facing, HeadingOf(to - actor.place()))) < kBeforeSeat;
  std::optional<glm::vec2> stand;
  if (distance >= 0.8f * kGiveNearest && distance <= kGiveFurthest && is_before) {
    stand = actor.place();
  } else {
    stand = FindStand(world_, task.actor, {to, kGiveNearest, kGiveFurthest, facing});
  }
  if (!stand) {
    Fail(task, what() + ", who is out of reach");
    return true;
  }
  EndWalk(world_, world_.actor(task.partner));
  return Approach(task, *stand, HeadingOf(to - *stand));
}

// ---- waiting ----

bool Tasks::IsFirstOf(const Task& task) const {
  return std::none_of(tasks_.begin(), tasks_.end(), [&](const Task& other) {
    return other.id < task.id && other.stage == Stage::kWaiting && other.actor == task.actor;
  });
}

// Who waits for an object that has places stands in its line.
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
    EndWalk(world_, actor);  // no nearer than here
  }
}

// Whoever stands about where somebody has to stand, or cannot get past, steps aside.
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
