#include "shared/stage/task_reservations.h"

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

constexpr float kReachNearest = 0.42f;   // Metres to the grip, for a person 1.7 m tall.
constexpr float kReachFurthest = 0.85f;  // Metres, leaning over a counter.
constexpr float kNearerByArms = 0.25f;   // Metres nearer to a place, times (1 - body scale).
constexpr float kTwistAllowed = 0.5f;    // Radians that hands may twist.
constexpr float kGiveNearest = 0.75f;    // Metres between two actors.
constexpr float kGiveFurthest = 1.05f;
constexpr float kBeforeSeat = 0.8f;  // Radians from the front of a seated receiver.

glm::vec2 OnFloor(const glm::vec3& point) { return {point.x, point.z}; }

// Speed of the walking clip; without one, a speed that depends on body size (constant Froude
// number).
float ComfortableSpeed(const Actor& actor) {
  if (actor.walk_clip >= 0) {
    const human::Clip& clip = actor.human().clips[static_cast<size_t>(actor.walk_clip)];
    return clip.stride / clip.duration;
  }
  return kWalkSpeed * std::sqrt(actor.eye_height() / 1.58f);
}

}  // namespace

// ---- sitting ----

bool TaskReservations::CanReachSitting(ActorId id, const glm::vec3& point) const {
  // Metres in the frame of StageFromUpperBody, for a person 1.7 m tall.
  constexpr float kFurthest = 0.78f;
  constexpr float kLowest = 0.70f, kHighest = 1.7f;
  constexpr float kAside = 1.1f;  // Radians.
  const Actor& actor = world_.actor(id);
  Pose at = StageFromUpperBody(actor).Inverse() * Pose{point};
  at.position /= ScaledTo(actor, {{1.0f, 0.0f, 0.0f}}).position.x;
  const glm::vec2 way = OnFloor(at.position);
  return glm::length(way) < kFurthest && std::abs(HeadingOf(way)) < kAside &&
         at.position.y > kLowest && at.position.y < kHighest;
}

bool TaskReservations::IsDoneSitting(const TaskRequest& task) const {
  const Object* object = world_.objects.Find(task.object);
  switch (task.kind) {
    case TaskKind::kWalk:
      return false;
    case TaskKind::kUse:
      return object->use().actions[static_cast<size_t>(task.action)].held;
    case TaskKind::kTake:
      return object->state.holder == task.actor ||
             CanReachSitting(task.actor, object->state.stage_from_object.position);
    case TaskKind::kPut: {
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
    case TaskKind::kGive:
      return glm::distance(world_.actor(task.actor).place(), world_.actor(task.partner).place()) <
             kGiveFurthest;
  }
  return false;
}

// Whether the spot is on the requested surface and, if the actor sits, in its reach.
bool TaskReservations::IsSpotFor(const TaskRequest& task, int surface, int spot) const {
  if (task.target.surface >= 0 && task.target.surface != surface) {
    return false;
  }
  const Object& on = world_.object(task.target.object);
  return !queue_.Sits(task.actor) ||
         CanReachSitting(task.actor, (on.state.stage_from_object *
                                      ObjectFromSpot(*on.model, on.state.joints, surface, spot))
                                         .position);
}

bool TaskReservations::GetsUpFor(const TaskRequest& task) {
  Task* seat = queue_.SeatOf(task.actor);
  if (seat == nullptr || IsDoneSitting(task)) {
    return false;
  }
  seat->stage = TaskStage::kRunning;
  steps_.Enter(*seat, TaskPhase::kRise);
  return true;
}

// ---- reservations ----

bool TaskReservations::Reserve(Task& task) {
  const Actor& actor = world_.actor(task.actor);
  if (!actor.state.visible) {
    task.Fail(Quoted(actor.name) + " is not on the stage; place it first");
    return true;
  }
  const bool gets_up =
      actor.state.animation_state.sitting.amount > 0.0f && !queue_.Sits(task.actor);
  if (gets_up || GetsUpFor(task)) {
    return false;
  }
  switch (task.kind) {
    case TaskKind::kWalk:
      if (task.only_turns) {
        Walk& walk = world_.actor(task.actor).walk;
        EndWalk(world_, world_.actor(task.actor));
        walk = {};
        walk.phase = Walk::Phase::kFace;
        walk.heading = task.heading;
        walk.turn_speed = task.speed;
        steps_.Enter(task, TaskPhase::kApproach);
        return true;
      }
      return Approach(task, task.goal, task.heading);
    case TaskKind::kUse:
      return ReserveUse(task);
    case TaskKind::kTake:
      return ReserveTake(task);
    case TaskKind::kPut:
      return ReservePut(task);
    case TaskKind::kGive:
      return ReserveGive(task);
  }
  return true;
}

bool TaskReservations::Approach(Task& task, glm::vec2 goal, std::optional<float> heading) {
  Actor& actor = world_.actor(task.actor);
  const float speed = task.speed > 0.0f ? task.speed : ComfortableSpeed(actor);
  const Status status = BeginWalk(world_, actor, goal, heading, speed);
  if (!status.ok()) {
    task.Fail(status.message());
    return true;
  }
  if (!actor.walk.complete) {
    const auto centimetres = [](float x) {
      return std::to_string(std::round(x * 100.0f) / 100.0f).substr(0, x < 0.0f ? 5 : 4);
    };
    task.message = Quoted(actor.name) +
                   " cannot get there; the nearest place is x = " + centimetres(actor.walk.goal.x) +
                   ", z = " + centimetres(actor.walk.goal.y);
    if (task.kind != TaskKind::kWalk) {
      EndWalk(world_, actor);
      task.Fail(task.message);
      return true;
    }
  }
  steps_.Enter(task, TaskPhase::kApproach);
  return true;
}

bool TaskReservations::ApproachNear(Task& task,
                                    const glm::vec3& point,
                                    std::optional<float> facing) {
  if (queue_.Sits(task.actor)) {
    steps_.Arrive(task);
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
    stand = actor.place();  // The point is in reach from here.
  } else {
    stand = FindStand(world_, task.actor, wish);
  }
  if (!stand) {
    wish.among_others = true;  // The others make way or leave.
    stand = FindStand(world_, task.actor, wish);
  }
  if (!stand) {
    task.Fail(Quoted(actor.name) + " cannot get near enough to " +
              Quoted(world_.object(task.object).name));
    return true;
  }
  return Approach(task, *stand, HeadingOf(on_floor - *stand));
}

bool TaskReservations::ApproachPlaceOf(Task& task, ObjectId id, int place) {
  if (queue_.Sits(task.actor)) {
    steps_.Arrive(task);
    return true;
  }
  if (queue_.IsPlaceTaken(id, place, task)) {
    return false;
  }
  task.place_of = id;
  task.place = place;
  const Object& object = world_.object(id);
  const ApproachPlace& at = object.use().places[static_cast<size_t>(place)];
  // Places are meant for a person 1.7 m tall: an actor with shorter arms stands nearer.
  const float scale = ScaledTo(world_.actor(task.actor), {{1.0f, 0.0f, 0.0f}}).position.x;
  const glm::vec2 nearer = kNearerByArms * std::max(0.0f, 1.0f - scale) * Direction(at.heading);
  return Approach(task, InStage(object, at.position + nearer), HeadingInStage(object, at.heading));
}

bool TaskReservations::ReserveUse(Task& task) {
  const Object& object = world_.object(task.object);
  const ObjectAction& action = object.use().actions[static_cast<size_t>(task.action)];
  const Actor& actor = world_.actor(task.actor);
  const auto what = [&] {
    return Quoted(actor.name) + " cannot '" + action.name + "' " + Quoted(object.name);
  };
  if (!action.held && queue_.UsersOf(task.object, task) >= object.use().capacity) {
    return false;
  }
  if ((action.from >> object.state.state & 1u) == 0) {
    task.Fail(what() + ": it is " +
              Quoted(object.use().states[static_cast<size_t>(object.state.state)]));
    return true;
  }
  if (action.held != (object.state.holder == task.actor)) {
    task.Fail(what() + (action.held ? ": it does not hold it" : ": it holds it in its hands"));
    return true;
  }
  if (!action.held && object.state.holder) {
    task.Fail(what() + ": it is in the hands of " + Quoted(world_.actor(object.state.holder).name));
    return true;
  }
  const auto hands = ChooseHands(world_, task.actor, task.object, action.hands);
  if (!hands) {
    task.Fail(what() + ": its hands are full");
    return true;
  }
  task.hands = *hands;
  if (action.held) {
    steps_.Enter(task, TaskPhase::kReach);
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
    if (queue_.IsPlaceTaken(task.object, static_cast<int>(i), task)) {
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

bool TaskReservations::ReserveTake(Task& task) {
  const Object& object = world_.object(task.object);
  const Actor& actor = world_.actor(task.actor);
  if (object.state.holder == task.actor) {
    task.Finish();
    return true;
  }
  const auto what = [&] { return Quoted(actor.name) + " cannot take " + Quoted(object.name); };
  if (object.state.holder) {
    task.Fail(what() + ": it is in the hands of " + Quoted(world_.actor(object.state.holder).name) +
              "; let them give it or put it down");
    return true;
  }
  const auto hands = ChooseHands(world_, task.actor, task.object, object.use().carry->hands);
  if (!hands) {
    task.Fail(what() + ": its hands are full");
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

bool TaskReservations::ReservePut(Task& task) {
  const Object& object = world_.object(task.object);
  const Actor& actor = world_.actor(task.actor);
  const auto what = [&] {
    return Quoted(actor.name) + " cannot put " + Quoted(object.name) + " there";
  };
  if (object.state.holder != task.actor) {
    task.Fail(what() + ": it does not hold it");
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
    task.Fail(what() + ": that stands on what it holds");
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
      const bool is_wanted =
          std::any_of(queue_.tasks().begin(), queue_.tasks().end(), [&](const Task& other) {
            return other.id != task.id && other.kind == TaskKind::kPut &&
                   other.stage == TaskStage::kRunning &&
                   other.target.object == task.target.object && other.target.surface == at_s &&
                   other.spot == at_i;
          });
      if (is_wanted || IsOccupied(world_, task.target.object, at_s, at_i)) {
        continue;
      }
      const int place = on.use().surfaces[s].spots[i].place;
      if (place >= 0 && queue_.IsPlaceTaken(task.target.object, place, task)) {
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
  // A spot that another task is clearing will be free.
  for (const Task& other : queue_.tasks()) {
    if (other.id != task.id && other.kind == TaskKind::kTake &&
        other.stage == TaskStage::kRunning &&
        world_.object(other.object).state.support.object == task.target.object) {
      may_become_free = true;
    }
  }
  if (spot < 0) {
    if (may_become_free) {
      return false;
    }
    task.Fail(what() + ": there is no free spot on " + Quoted(on.name));
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

bool TaskReservations::ReserveGive(Task& task) {
  const Object& object = world_.object(task.object);
  const Actor& actor = world_.actor(task.actor);
  const Actor& partner = world_.actor(task.partner);
  const auto what = [&] {
    return Quoted(actor.name) + " cannot give " + Quoted(object.name) + " to " +
           Quoted(partner.name);
  };
  if (object.state.holder != task.actor) {
    task.Fail(what() + ": it does not hold it");
    return true;
  }
  if (!partner.state.visible) {
    task.Fail(what() + ", who is not on the stage");
    return true;
  }
  task.hands = object.state.hands;
  if (queue_.Sits(task.actor)) {
    steps_.Arrive(task);
    return true;
  }
  // A seated receiver takes the object from the front.
  const glm::vec2 to = OnFloor(StageFromUpperBody(partner).position);
  const float distance = glm::distance(actor.place(), to);
  std::optional<float> facing;
  if (queue_.Sits(task.partner)) {
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
    task.Fail(what() + ", who is out of reach");
    return true;
  }
  EndWalk(world_, world_.actor(task.partner));
  return Approach(task, *stand, HeadingOf(to - *stand));
}

}  // namespace lararium::stage
