#pragma once

// An actor: a person on the stage, what it does, and what a drama has told it.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "shared/core/id.h"
#include "shared/core/random.h"
#include "shared/human/human.h"
#include "shared/human/performance.h"
#include "shared/stage/object.h"

namespace lararium::stage {

// What an actor says, or has just said: whoever plays it or shows it as text needs nothing
// else, so that jumping into the middle of a line is as playing until there.
struct Utterance {
  int line = -1;          // index of the stage's lines; -1: none
  int64_t ticks = 0;      // of Stage::kTickSeconds since it began
  bool speaking = false;  // false: said to its end, and still to be read

  friend bool operator==(const Utterance&, const Utterance&) = default;
};

// All that is to be seen and heard of an actor; plain values.
struct ActorState {
  glm::vec3 position = glm::vec3(0.0f);  // stage, metres; the ground between the feet
  float heading = 0.0f;                  // radians about +Y; 0 faces -Z, a quarter turn faces -X
  bool visible = false;
  human::Performance performance;
  Utterance utterance;

  friend bool operator==(const ActorState&, const ActorState&) = default;
};

// A walk from where the actor is to a place and perhaps a heading.
struct Walk {
  enum class Phase : uint8_t {
    kNone,   // there is no walk
    kTurn,   // on the spot, to face the way
    kLeave,  // straight onto the mesh
    kGo,     // over the mesh, avoiding others
    kDock,   // straight to the exact place
    kFace,   // on the spot, to the heading at the end
  };

  Phase phase = Phase::kNone;
  glm::vec2 goal = glm::vec2(0.0f);     // where it ends, (x, z)
  glm::vec2 on_mesh = glm::vec2(0.0f);  // the mesh's point for it
  glm::vec2 corner = glm::vec2(0.0f);   // the way's first, or where the mesh begins
  std::optional<float> heading;         // at the end, radians
  float speed = 1.2f;                   // m/s
  float turn_speed = 0.0f;              // rad/s, of kFace; 0: as people do
  bool complete = true;                 // false: the goal is as near as one gets
  float nearest = 0.0f;                 // metres that were left at best
  float stuck = 0.0f;                   // seconds without getting nearer
  float pace = 0.0f;                    // of straight ways, m/s
};

// What an actor looks at.
struct Attention {
  enum class Target : uint8_t { kNothing, kPoint, kActor, kObject, kVisitor };
  struct Choice {
    Target target = Target::kNothing;
    glm::vec3 point = glm::vec3(0.0f);  // stage
    ActorId actor;
    ObjectId object;
  };

  std::optional<Choice> told;  // by the drama; none: by itself
  bool automatic = true;       // chooses by itself where nothing was told
  Choice chosen;
  float seconds_left = 0.0f;  // until it chooses anew
  Random random = Random(1);
};

struct Actor {
  std::string name;
  std::shared_ptr<const human::PerformanceModel> model;
  ActorState state;

  Walk walk;
  int walker = -1;  // in the navigation; -1: not there
  Attention attention;
  double clip_ends = -1.0;                     // seconds until a gesture ends; below 0: none
  int clip_after = human::Animation::kNoClip;  // what plays when gesture or walk has ended
  bool in_gait = false;                        // the clip is that of walking
  int walk_clip = human::Animation::kNoClip;   // of the figure: "walk", if it moves forward
  int idle_clip = human::Animation::kNoClip;   // "idle"
  bool led = false;  // by a track: it makes way for nobody and takes no task

  const human::Human& human() const { return *model->human; }
  glm::vec2 place() const { return {state.position.x, state.position.z}; }
  // Of the eyes when it stands upright, metres; the rest of its size goes with it.
  float eye_height() const { return model->gaze.eyes.y; }
};

// stage_from_actor of an actor that stands and faces as its state says.
glm::mat4 StageFromActor(const ActorState& state);
Pose StageFromActorPose(const ActorState& state);
// Likewise, moved along with hips that sink onto a seat: where arms and eyes are as they
// are upright.
Pose StageFromUpperBody(const Actor& actor);

// The way that somebody faces who has a heading, (x, z), and back.
glm::vec2 Direction(float heading);
float HeadingOf(glm::vec2 direction);
// The shorter turn from one heading to another, -pi..pi.
float TurnBetween(float from, float to);

// Between two neighbouring ticks, alpha 0..1; current after a jump.
ActorState Interpolate(const ActorState& previous, const ActorState& current, float alpha);

// -1: it has none of that name.
int FindClip(const human::Human& human, std::string_view name);

}  // namespace lararium::stage
