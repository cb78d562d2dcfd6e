#pragma once

// Walks of actors over the stage's floor. Internal to shared/stage.

#include "shared/core/status.h"
#include "shared/stage/world.h"

namespace lararium::stage {

// Converts a ground point (x, z) and a heading from the object frame to the stage frame.
glm::vec2 InStage(const Object& object, glm::vec2 point);
float HeadingInStage(const Object& object, float heading);

enum class WalkResult : uint8_t { kGoing, kArrived, kBlocked };

inline constexpr float kWalkSpeed = 1.2f;  // Metres per second, for a person 1.7 m tall.

// Starts a walk. If the goal cannot be reached, the actor walks to the nearest reachable point and
// walk.complete is false. Error: the actor stands too far from the walkable floor.
Status BeginWalk(
    World& world, Actor& actor, glm::vec2 goal, std::optional<float> heading, float speed);
// Advances a walk by one tick.
WalkResult AdvanceWalk(World& world, Actor& actor, float seconds);
// Stops the actor where it is.
void EndWalk(World& world, Actor& actor);

// Updates the navigation's walkers from the actors.
void SyncWalkers(World& world);

// Turns on the spot towards a heading, at `speed` in rad/s or, if it is 0, at a natural speed.
// Returns true when the heading is reached.
bool TurnTowards(Actor& actor, float heading, float seconds, float speed = 0.0f);

// Whether no other actor stands, or is about to stand, within `within` metres of a point.
bool IsFree(const World& world, ActorId except, glm::vec2 place, float within);

// Criteria for a place to stand that is in reach of a point.
struct StandWish {
  glm::vec2 point = glm::vec2(0.0f);  // (x, z), stage frame, metres.
  float nearest = 0.0f;               // Smallest and largest distance to the point, metres.
  float furthest = 0.0f;
  std::optional<float> facing = std::nullopt;  // Preferred heading towards the point.
  bool among_others = false;                   // Places where others stand are allowed.
};

// The best place that can be reached; none: there is no such place.
std::optional<glm::vec2> FindStand(const World& world, ActorId actor, const StandWish& wish);

// A nearby place to step aside to, so that `place` becomes free.
std::optional<glm::vec2> FindAside(const World& world, ActorId actor, glm::vec2 place);

}  // namespace lararium::stage
