#include "shared/stage/walking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/core/units.h"

namespace lararium::stage {
namespace {
constexpr float kSameSpot = 0.02f;      // Metres; shorter walks are skipped.
constexpr float kSideStep = 0.4f;       // Metres; shorter walks do not turn first.
constexpr float kSetOff = 1.0f;         // Radians off the path at which the walk starts.
constexpr float kBraking = 1.3f;        // m/s^2
constexpr float kStarting = 1.6f;       // m/s^2
constexpr float kRoomAtGoal = 0.42f;    // Metres to any other actor.
constexpr float kSqueezeAfter = 3.0f;   // Seconds without getting nearer.
constexpr float kPushAfter = 8.0f;      // Seconds without getting nearer.
constexpr float kGiveUpAfter = 15.0f;   // Seconds without getting nearer.
constexpr float kTwistCost = 3.0f;      // Metres of path that one radian of twist is worth.
constexpr float kNearer = 0.05f;        // Metres that count as getting nearer.
constexpr float kTurnPerRadian = 5.0f;  // 1/s
constexpr float kTurnFastest = kPiF;    // radians per second

bool HasSpot(const Walk& walk) {
  return walk.phase != Walk::Phase::kNone && walk.phase != Walk::Phase::kTurn;
}

void TurnAlong(Actor& actor, glm::vec2 direction, float seconds) {
  TurnTowards(actor, HeadingOf(direction), seconds);
}

// Steps straight towards a point, accelerating and braking gently. True: the point is reached.
bool StepTowards(Actor& actor, glm::vec2 point, float speed, bool stops, float seconds) {
  Walk& walk = actor.walk;
  const glm::vec2 way = point - actor.place();
  const float left = glm::length(way);
  const float allowed = stops ? std::min(speed, std::sqrt(2.0f * kBraking * left) + 0.02f) : speed;
  walk.pace = std::min(allowed, walk.pace + kStarting * seconds);
  const float step = walk.pace * seconds;
  const glm::vec2 next = step >= left ? point : actor.place() + step / left * way;
  actor.state.position.x = next.x;
  actor.state.position.z = next.y;
  return step >= left;
}

void Go(World& world, Actor& actor) {
  Walk& walk = actor.walk;
  walk.phase = Walk::Phase::kGo;
  walk.stuck = 0.0f;
  walk.nearest = glm::distance(actor.place(), walk.on_mesh);
  world.navigation->Place(actor.walker, actor.place(), walk.pace * Direction(actor.state.heading));
  world.navigation->Aim(actor.walker, walk.on_mesh, walk.speed);
}

void Dock(World& world, Actor& actor) {
  Walk& walk = actor.walk;
  walk.phase = Walk::Phase::kDock;
  walk.pace = glm::length(world.navigation->velocity(actor.walker));
  world.navigation->Squeeze(actor.walker, 0);
  world.navigation->Hold(actor.walker);
}

// Whether the goal is near and nothing lies in between.
bool MayDock(const World& world, ActorId id, const Actor& actor, glm::vec2 velocity) {
  const Walk& walk = actor.walk;
  const float pace = glm::length(velocity);
  const float left = glm::distance(actor.place(), walk.goal);
  if (left > std::max(0.25f, pace * pace / (2.0f * kBraking) + 0.05f) +
                 glm::distance(walk.goal, walk.on_mesh)) {
    return false;
  }
  if (!IsFree(world, id, walk.goal, kRoomAtGoal)) {
    return false;
  }
  const auto way = world.navigation->FindWay(actor.place(), walk.on_mesh);
  const float straight = glm::distance(actor.place(), walk.on_mesh);
  return way.has_value() && way->length < 1.1f * straight + 0.05f;
}

WalkResult AdvanceGo(World& world, ActorId id, Actor& actor, float seconds) {
  Walk& walk = actor.walk;
  const glm::vec2 place = world.navigation->position(actor.walker);
  const glm::vec2 velocity = world.navigation->velocity(actor.walker);
  actor.state.position.x = place.x;
  actor.state.position.z = place.y;
  if (glm::length(velocity) > 0.1f) {
    TurnAlong(actor, velocity, seconds);
  }
  if (MayDock(world, id, actor, velocity)) {
    Dock(world, actor);
    return WalkResult::kGoing;
  }
  const float left = glm::distance(place, walk.on_mesh);
  // A path may lead away from the goal for a while: a moving actor is not stuck.
  if (left < walk.nearest - kNearer || glm::length(velocity) > 0.35f * walk.speed) {
    walk.nearest = std::min(left, walk.nearest);
    walk.stuck = std::max(0.0f, walk.stuck - 2.0f * seconds);
  } else {
    walk.stuck += seconds;
  }
  world.navigation->Squeeze(actor.walker, walk.stuck > kPushAfter      ? 2
                                          : walk.stuck > kSqueezeAfter ? 1
                                                                       : 0);
  return walk.stuck > kGiveUpAfter ? WalkResult::kBlocked : WalkResult::kGoing;
}

WalkResult AdvanceDock(Actor& actor, float seconds) {
  Walk& walk = actor.walk;
  const glm::vec2 way = walk.goal - actor.place();
  const float left = glm::length(way);
  if (walk.heading && left < kSideStep) {
    TurnTowards(actor, *walk.heading, seconds);
  } else if (left > 0.1f) {
    TurnAlong(actor, way, seconds);
  }
  if (StepTowards(actor, walk.goal, walk.speed, true, seconds)) {
    walk.phase = Walk::Phase::kFace;
    walk.pace = 0.0f;
  }
  return WalkResult::kGoing;
}

// The place moved close enough to the mesh: to reach over something, people stand nearer to it than
// when they walk past. None: too far from the mesh.
std::optional<glm::vec2> CloseTo(const Navigation& navigation, glm::vec2 place) {
  constexpr float kCloser = 0.12f;  // Allowed distance from the mesh, metres.
  constexpr float kPulled = 0.2f;   // Metres by which a place may be moved towards the mesh.
  const auto on_mesh = navigation.Nearest(place, kCloser + kPulled);
  if (!on_mesh) {
    return std::nullopt;
  }
  const float off = glm::distance(*on_mesh, place);
  return off <= kCloser ? place : *on_mesh + kCloser / off * (place - *on_mesh);
}

ActorId IdOf(const World& world, const Actor& actor) {
  for (const ActorId id : world.actor_ids) {
    if (world.actors.Find(id) == &actor) {
      return id;
    }
  }
  return {};
}

}  // namespace

glm::vec2 InStage(const Object& object, glm::vec2 point) {
  const glm::vec3 in_stage = object.state.stage_from_object * glm::vec3(point.x, 0.0f, point.y);
  return {in_stage.x, in_stage.z};
}

float HeadingInStage(const Object& object, float heading) {
  const glm::vec2 direction = Direction(heading);
  const glm::vec3 in_stage =
      object.state.stage_from_object.rotation * glm::vec3(direction.x, 0.0f, direction.y);
  return HeadingOf({in_stage.x, in_stage.z});
}

bool TurnTowards(Actor& actor, float heading, float seconds, float speed) {
  const float turn = TurnBetween(actor.state.heading, heading);
  const float pace =
      speed > 0.0f ? speed : std::min(kTurnPerRadian * std::abs(turn) + 0.1f, kTurnFastest);
  const float most = pace * seconds;
  actor.state.heading += std::clamp(turn, -most, most);
  return std::abs(turn) <= most;
}

Status BeginWalk(
    World& world, Actor& actor, glm::vec2 goal, std::optional<float> heading, float speed) {
  EndWalk(world, actor);
  SyncWalkers(world);
  if (actor.walker < 0) {
    return Status::Error(actor.name, "is not on the stage", "place it there first");
  }
  const glm::vec2 from = actor.place();
  Walk walk;
  walk.goal = goal;
  walk.heading = heading;
  walk.speed = speed;
  if (glm::distance(from, goal) < kSameSpot) {
    walk.phase = Walk::Phase::kDock;
    walk.on_mesh = goal;
    actor.walk = walk;
    return Status();
  }
  const auto way = world.navigation->FindWay(from, goal);
  if (!way) {
    return Status::Error(actor.name, "stands where no one can walk",
                         "place it on the stage's floor");
  }
  walk.on_mesh = way->point;
  walk.complete = way->complete && glm::distance(way->point, goal) <= Navigation::kStepOn;
  if (!walk.complete) {
    walk.goal = way->point;
  }
  const float straight = glm::distance(from, walk.goal);
  const auto start = world.navigation->Nearest(from, Navigation::kStepOn);
  const bool is_step = straight < kSideStep && way->length < 1.2f * straight + 0.05f;
  walk.corner = start && glm::distance(*start, from) > 0.03f ? *start : way->corner;
  walk.phase = is_step ? Walk::Phase::kDock : Walk::Phase::kTurn;
  actor.walk = walk;
  return Status();
}

WalkResult AdvanceWalk(World& world, Actor& actor, float seconds) {
  Walk& walk = actor.walk;
  const ActorId id = IdOf(world, actor);
  switch (walk.phase) {
    case Walk::Phase::kNone:
      return WalkResult::kArrived;
    case Walk::Phase::kTurn: {
      const glm::vec2 way = walk.corner - actor.place();
      const bool off_mesh = !world.navigation->Nearest(actor.place(), 0.03f).has_value();
      const bool short_way = glm::length(way) < 0.05f;
      if (!short_way) {
        TurnAlong(actor, way, seconds);
      }
      if (short_way || std::abs(TurnBetween(actor.state.heading, HeadingOf(way))) < kSetOff) {
        if (off_mesh) {
          walk.phase = Walk::Phase::kLeave;
        } else {
          Go(world, actor);
        }
      }
      return WalkResult::kGoing;
    }
    case Walk::Phase::kLeave:
      TurnAlong(actor, walk.corner - actor.place(), seconds);
      if (StepTowards(actor, walk.corner, walk.speed, false, seconds)) {
        Go(world, actor);
      }
      return WalkResult::kGoing;
    case Walk::Phase::kGo:
      return AdvanceGo(world, id, actor, seconds);
    case Walk::Phase::kDock:
      return AdvanceDock(actor, seconds);
    case Walk::Phase::kFace:
      if (walk.heading && !TurnTowards(actor, *walk.heading, seconds, walk.turn_speed)) {
        return WalkResult::kGoing;
      }
      EndWalk(world, actor);
      return WalkResult::kArrived;
  }
  return WalkResult::kArrived;
}

void EndWalk(World& world, Actor& actor) {
  if (actor.walk.phase == Walk::Phase::kGo) {
    world.navigation->Squeeze(actor.walker, 0);
    world.navigation->Hold(actor.walker);
  }
  actor.walk.phase = Walk::Phase::kNone;
  actor.walk.pace = 0.0f;
}

void SyncWalkers(World& world) {
  if (world.navigation == nullptr) {
    return;
  }
  for (const ActorId id : world.actor_ids) {
    Actor& actor = world.actor(id);
    const bool is_there = actor.walker >= 0;
    if (actor.state.visible && !is_there) {
      actor.walker = world.navigation->AddWalker(actor.place()).value_or(-1);
    } else if (!actor.state.visible && is_there) {
      world.navigation->RemoveWalker(actor.walker);
      actor.walker = -1;
    }
    if (actor.walker >= 0 && actor.walk.phase != Walk::Phase::kGo) {
      world.navigation->Place(actor.walker, actor.place(),
                              actor.walk.pace * Direction(actor.state.heading));
    }
  }
}

bool IsFree(const World& world, ActorId except, glm::vec2 place, float within) {
  return std::none_of(world.actor_ids.begin(), world.actor_ids.end(), [&](ActorId id) {
    const Actor& other = *world.actors.Find(id);
    if (id == except || !other.state.visible) {
      return false;
    }
    const bool stands_there = glm::distance(other.place(), place) < within;
    const bool is_off = HasSpot(other.walk) && glm::distance(other.walk.goal, place) >= within;
    const bool comes =
        other.walk.phase == Walk::Phase::kDock && glm::distance(other.walk.goal, place) < within;
    return (stands_there && !is_off) || comes;
  });
}

std::optional<glm::vec2> FindStand(const World& world, ActorId actor, const StandWish& wish) {
  constexpr int kDirections = 24;
  constexpr int kRings = 5;
  struct Candidate {
    glm::vec2 place;
    float cost;    // Cost without the path.
    float bound;   // Lower bound of the cost with the path: adds the straight distance.
    size_t order;  // Breaks ties, so that every platform finds the same place.
  };
  std::array<Candidate, static_cast<size_t>(kDirections * kRings)> candidates;
  size_t count = 0;
  const glm::vec2 from = world.actors.Find(actor)->place();
  for (int ring = 0; ring < kRings; ++ring) {
    const float radius = glm::mix(wish.nearest, wish.furthest,
                                  static_cast<float>(ring) / static_cast<float>(kRings - 1));
    for (int i = 0; i < kDirections; ++i) {
      const float angle = 2.0f * kPiF * static_cast<float>(i) / kDirections;
      const auto place = CloseTo(*world.navigation, wish.point + radius * Direction(angle));
      if (!place || (!wish.among_others && !IsFree(world, actor, *place, kRoomAtGoal))) {
        continue;
      }
      const glm::vec2 way = wish.point - *place;
      const float distance = glm::length(way);
      if (distance < wish.nearest - kNearer || distance > wish.furthest + kNearer) {
        continue;
      }
      // A place nearer to the point is better than a shorter path.
      const float twist = wish.facing ? std::abs(TurnBetween(*wish.facing, HeadingOf(way))) : 0.0f;
      const float cost = 2.0f * distance + kTwistCost * twist;
      candidates[count] = {*place, cost, cost + glm::distance(from, *place), count};
      ++count;
    }
  }
  std::sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Candidate& a, const Candidate& b) {
              return a.bound < b.bound || (a.bound == b.bound && a.order < b.order);
            });
  std::optional<glm::vec2> best;
  float least = std::numeric_limits<float>::max();
  for (size_t i = 0; i < count && candidates[i].bound < least; ++i) {
    const auto way = world.navigation->FindWay(from, candidates[i].place);
    if (way && way->complete && candidates[i].cost + way->length < least) {
      least = candidates[i].cost + way->length;
      best = candidates[i].place;
    }
  }
  return best;
}

std::optional<glm::vec2> FindAside(const World& world, ActorId actor, glm::vec2 place) {
  return FindStand(world, actor, {.point = place, .nearest = 0.8f, .furthest = 1.6f});
}

}  // namespace lararium::stage
