#pragma once

// An object on the stage: its model, its pose, its state and its holder.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/core/ease.h"
#include "shared/core/id.h"
#include "shared/human/reach.h"
#include "shared/light/lamp.h"
#include "shared/stage/object_use.h"
#include "shared/stage/prop.h"

namespace lararium::stage {

struct Actor;
using ActorId = Id<Actor>;
struct Object;
using ObjectId = Id<Object>;

// The spot of another object on which an object stands.
struct Support {
  ObjectId object;  // Zero: the object stands on no other.
  int8_t surface = -1;
  int8_t spot = -1;
  float turn = 0.0f;  // Radians about the +Y axis of the spot.

  friend bool operator==(const Support&, const Support&) = default;
};

// How the drama has changed an object's lights.
struct LightState {
  float level = 1.0f;                  // Factor of the intensities in the object's file.
  glm::vec3 colour = glm::vec3(0.0f);  // Linear RGB of luminance 1; zero: as in the file.

  friend bool operator==(const LightState&, const LightState&) = default;
};

// Everything about an object that a drama changes. Plain values.
struct ObjectState {
  Pose stage_from_object;
  std::array<float, ObjectUse::kMaxJoints> joints = {};  // Radians or metres.
  int state = 0;                                         // Index into ObjectUse::states.
  bool visible = true;
  Support support;
  ActorId holder;              // Zero: no one holds it.
  HandGrips hands = kNoHands;  // Hands of the holder.
  // DrawnPose blends from stage_from_object (in_hand = 0) to the pose in the palm of `hand`
  // (in_hand = 1), so that a held object never leaves the hand.
  int8_t hand = -1;  // human::kRight or kLeft; -1: both hands or none.
  float in_hand = 0.0f;
  // The action that is being done with the object, for its sound; -1: none.
  int8_t action = -1;        // Index into ObjectUse::actions.
  float action_time = 0.0f;  // Seconds since the action began.
  LightState light;

  friend bool operator==(const ObjectState&, const ObjectState&) = default;
};

struct Object {
  std::string name;
  std::shared_ptr<const ObjectModel> model;
  Pose initial_pose;  // stage_from_object at the start of the drama.
  ObjectState state;

  // Pose of a held object in the frame of its holder's upper body, while it moves from one pose to
  // another (minimum jerk).
  struct Held {
    Pose from;
    Pose to;
    float time = 0.0f;
    float duration = 0.0f;     // Seconds.
    bool rests = false;        // `to` is the carrying pose.
    bool comes_loose = false;  // The palm is about to leave the object.

    Pose now() const;
  };
  Held held;

  // A transition of LightState::level.
  struct Dimming {
    float to = 1.0f;
    float seconds_left = 0.0f;
    float from = 1.0f;
    float seconds = 0.0f;  // Duration of the transition.
    Ease ease = Ease::kLinear;
  };
  Dimming dimming;
  uint64_t seed = 0;  // Seed of the flicker, derived from the name.

  const ObjectUse& use() const { return model->use(); }
};

// State at the start: at the initial pose, joints at rest, visible and not held.
ObjectState InitialState(const Object& object);

// object_from_part of a part; part -1 is the object frame itself.
Pose ObjectFromPart(const ObjectModel& model, std::span<const float> joints, int part);
// object_from_hand of a grip.
Pose ObjectFromGrip(const ObjectModel& model, std::span<const float> joints, int grip);
// object_from_spot: the frame of an object that stands on the spot, turned by `turn` radians about
// its +Y axis.
Pose ObjectFromSpot(const ObjectModel& model,
                    std::span<const float> joints,
                    int surface,
                    int spot,
                    float turn = 0.0f);

// stage_from_object at which a held object is drawn. `holder_from_palm` is the palm of `state.hand`
// in the final pose of the holder (human::ActorFromPalm).
Pose DrawnPose(const ObjectModel& model,
               const ObjectState& state,
               const glm::mat4& stage_from_holder,
               const human::GripFrame& holder_from_palm);

// Computes, for each part of the prop, its transform and whether it is shown in this state. A part
// whose parent is not shown is not shown either.
void ComputeParts(const ObjectModel& model,
                  const ObjectState& state,
                  const Pose& stage_from_object,
                  std::span<glm::mat4> stage_from_part,
                  std::span<uint8_t> shown);

// Adds a lamp for each light that burns in the object's state. `time`: seconds of the drama.
void AddLamps(const Object& object,
              const ObjectState& state,
              const Pose& stage_from_object,
              double time,
              std::vector<light::Lamp>& lamps);
// Factor of the emission of the object's meshes, from how its lights burn; 1 without lights.
float GlowOf(const Object& object, const ObjectState& state, double time);

// State between two consecutive ticks, alpha 0..1. Returns `current` if the object was moved by a
// jump or shown or hidden.
ObjectState Interpolate(const ObjectState& previous, const ObjectState& current, float alpha);

Pose Mix(const Pose& a, const Pose& b, float weight);
glm::mat4 ToMatrix(const Pose& pose);

}  // namespace lararium::stage
