#pragma once

// An actor: a person on the stage with its state, its walk and the orders of the drama.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "shared/core/id.h"
#include "shared/core/random.h"
#include "shared/human/animator.h"
#include "shared/human/human.h"
#include "shared/stage/object.h"

namespace lararium::stage {

// The line that an actor says or has just said. Playing the sound and showing captions need nothing
// else, so a jump into the middle of a line gives the same result as playing up to there.
struct Utterance {
  int line = -1;          // Index into World::speeches; -1: none.
  int64_t ticks = 0;      // Ticks of Stage::kTickSeconds since the line began.
  bool speaking = false;  // False: the line has ended, but its captions are still shown.

  friend bool operator==(const Utterance&, const Utterance&) = default;
};

// Everything about an actor that is drawn or heard. Plain values.
struct ActorState {
  glm::vec3 position = glm::vec3(0.0f);  // Stage frame, metres; on the ground between the feet.
  float heading = 0.0f;                  // Radians about +Y; 0 faces -Z, pi/2 faces -X.
  bool visible = false;
  human::AnimationState animation_state;
  Utterance utterance;

  friend bool operator==(const ActorState&, const ActorState&) = default;
};

// A walk of an actor to a point of the floor and, optionally, a final heading.
struct Walk {
  enum class Phase : uint8_t {
    kNone,   // Not walking.
    kTurn,   // Turns on the spot to face the path.
    kLeave,  // Walks straight onto the navigation mesh.
    kGo,     // Walks over the mesh and avoids others.
    kDock,   // Walks straight to the exact goal.
    kFace,   // Turns on the spot to the final heading.
  };

  Phase phase = Phase::kNone;
  // Points are (x, z) in the stage frame, metres.
  glm::vec2 goal = glm::vec2(0.0f);
  glm::vec2 on_mesh = glm::vec2(0.0f);  // The point of the mesh that stands for the goal.
  glm::vec2 corner = glm::vec2(0.0f);   // First corner of the path, or where it enters the mesh.
  std::optional<float> heading;         // Final heading, radians.
  float speed = 1.2f;                   // m/s
  float turn_speed = 0.0f;              // Rad/s in kFace; 0: a natural speed.
  bool complete = true;                 // False: the goal is only the nearest reachable point.
  float nearest = 0.0f;                 // Smallest distance to the goal so far, metres.
  float stuck = 0.0f;                   // Seconds without getting nearer.
  float pace = 0.0f;                    // Current speed in kLeave and kDock, m/s.
};

// What an actor looks at.
struct Attention {
  enum class Target : uint8_t { kNothing, kPoint, kActor, kObject, kVisitor };
  struct Choice {
    Target target = Target::kNothing;
    glm::vec3 point = glm::vec3(0.0f);  // Stage frame, for kPoint.
    ActorId actor;
    ObjectId object;
  };

  std::optional<Choice> told;  // Target that the drama has set; none: not set.
  bool automatic = true;       // The actor chooses a target itself when `told` is none.
  Choice chosen;
  float seconds_left = 0.0f;  // Seconds until the actor chooses again.
  Random random = Random(1);
};

struct Actor {
  std::string name;
  std::shared_ptr<const human::AnimationRig> model;
  ActorState state;

  Walk walk;
  int walker = -1;  // Walker of Navigation; -1: none.
  Attention attention;
  double clip_ends = -1.0;  // Seconds until a gesture ends; negative: there is no gesture.
  int clip_after = human::Animation::kNoClip;  // Clip to play after the gesture or walk.
  bool in_gait = false;                        // The actor moves and its walking clip plays.
  int walk_clip = human::Animation::kNoClip;   // The clip "walk", if it moves forward.
  int idle_clip = human::Animation::kNoClip;   // The clip "idle".
  bool led = false;  // A track moves the actor: it does not step aside and accepts no task.

  const human::Human& human() const { return *model->human; }
  glm::vec2 place() const { return {state.position.x, state.position.z}; }
  // Height of the eyes when the actor stands upright, metres; a measure of its size.
  float eye_height() const { return model->gaze.eyes.y; }
};

// stage_from_actor at the position and heading of the state.
glm::mat4 StageFromActor(const ActorState& state);
Pose StageFromActorPose(const ActorState& state);
// Like StageFromActorPose, but shifted with the hips when the actor sits: in this frame arms and
// eyes are where they are when it stands.
Pose StageFromUpperBody(const Actor& actor);

// Converts between a heading in radians and a unit direction (x, z).
glm::vec2 Direction(float heading);
float HeadingOf(glm::vec2 direction);
// The shorter turn from one heading to another, radians, -pi..pi.
float TurnBetween(float from, float to);

// State between two consecutive ticks, alpha 0..1. Returns `current` if the actor was moved by a
// jump or shown or hidden.
ActorState Interpolate(const ActorState& previous, const ActorState& current, float alpha);

// Index into human::Human::clips; -1: there is no clip of this name.
int FindClip(const human::Human& human, std::string_view name);

}  // namespace lararium::stage
