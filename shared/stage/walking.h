#pragma once

// Walks of actors over the stage's floor. Private to the room.

#include "shared/core/status.h"
#include "shared/stage/world.h"

namespace lararium::stage {

// A point and a heading of an object's frame as they are on the stage's floor now.
glm::vec2 InStage(const Object& object, glm::vec2 point);
float HeadingInStage(const Object& object, float heading);

enum class WalkResult : uint8_t { kGoing, kArrived, kBlocked };

inline constexpr float kWalkSpeed = 1.2f;  // m/s, of somebody 1.7 m tall

// Begins a walk to a place. What cannot be reached is walked to as near as one gets:
// walk.complete says so. Fails where the actor stands too far from the floor.
Status BeginWalk(
    World& world, Actor& actor, glm::vec2 goal, std::optional<float> heading, float speed);
// One tick of it.
WalkResult AdvanceWalk(World& world, Actor& actor, float seconds);
// Stands still where it is.
void EndWalk(World& world, Actor& actor);

// Keeps the navigation's walkers as the actors are.
void SyncWalkers(World& world);

// Turns towards a heading as people do on the spot, or at a speed in rad/s; true once it
// is there.
bool TurnTowards(Actor& actor, float heading, float seconds, float speed = 0.0f);

// Whether nobody else stands, or is about to stand, within so many metres of a place.
bool IsFree(const World& world, ActorId except, glm::vec2 place, float within);

// Where somebody would like to stand: in reach of a point.
struct StandWish {
  glm::vec2 point = glm::vec2(0.0f);  // (x, z)
  float nearest = 0.0f;               // metres from it
  float furthest = 0.0f;
  std::optional<float> facing = std::nullopt;  // the heading in which to look at the point
  bool among_others = false;                   // also where others stand
};

// The best place to which there is a way; none: nowhere.
std::optional<glm::vec2> FindStand(const World& world, ActorId actor, const StandWish& wish);

// Somewhere near to step aside to, so that a place becomes free.
std::optional<glm::vec2> FindAside(const World& world, ActorId actor, glm::vec2 place);

}  // namespace lararium::stage
