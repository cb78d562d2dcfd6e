#pragma once

// An object on the stage: which one it is, where it is, and who has it.

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

// The spot of another object on which it stands.
struct Support {
  ObjectId object;  // zero: it stands by itself
  int8_t surface = -1;
  int8_t spot = -1;
  float turn = 0.0f;  // radians about the spot's +Y: as it was put there

  friend bool operator==(const Support&, const Support&) = default;
};

// What a drama makes of an object's lights.
struct LightState {
  float level = 1.0f;                  // times the intensities of the object's file
  glm::vec3 colour = glm::vec3(0.0f);  // linear RGB of luminance 1; zero: as in the file

  friend bool operator==(const LightState&, const LightState&) = default;
};

// All that a drama changes about an object; plain values.
struct ObjectState {
  Pose stage_from_object;
  std::array<float, ObjectUse::kMaxJoints> joints = {};  // radians or metres
  int state = 0;                                         // index into ObjectUse::states
  bool visible = true;
  Support support;
  ActorId holder;              // zero: nobody has it
  HandGrips hands = kNoHands;  // the holder's
  // How much it follows the palm of this hand, rather than stage_from_object: a hand
  // never loses what it holds (DrawnPose).
  int8_t hand = -1;  // human::kRight or kLeft; -1: held by both or by nobody
  float in_hand = 0.0f;
  // What is being done with it; -1: nothing. For whoever makes its sound.
  int8_t action = -1;        // index into ObjectUse::actions
  float action_time = 0.0f;  // seconds
  LightState light;

  friend bool operator==(const ObjectState&, const ObjectState&) = default;
};

struct Object {
  std::string name;
  std::shared_ptr<const ObjectModel> model;
  Pose initial_pose;  // stage_from_object
  ObjectState state;

  // While it is held: where it is in the frame of its holder's upper body, on its way from one pose
  // to another (minimum jerk).
  struct Held {
    Pose from;
    Pose to;
    float time = 0.0f;
    float duration = 0.0f;     // seconds
    bool rests = false;        // `to` is where it is carried
    bool comes_loose = false;  // the palm is about to leave it

    Pose now() const;
  };
  Held held;

  // The light's level is on its way.
  struct Dimming {
    float to = 1.0f;
    float seconds_left = 0.0f;
    float from = 1.0f;
    float seconds = 0.0f;  // that it takes
    Ease ease = Ease::kLinear;
  };
  Dimming dimming;
  uint64_t seed = 0;  // of its flicker; from its name

  const ObjectUse& use() const { return model->use(); }
};

// As the object is in its initial place, rested, seen, in nobody's hands.
ObjectState InitialState(const Object& object);

// object_from_part of a part; -1: the object's own frame.
Pose ObjectFromPart(const ObjectModel& model, std::span<const float> joints, int part);
// object_from_hand of a grip.
Pose ObjectFromGrip(const ObjectModel& model, std::span<const float> joints, int grip);
// object_from_spot: the frame of what stands there, turned about its +Y.
Pose ObjectFromSpot(const ObjectModel& model,
                    std::span<const float> joints,
                    int surface,
                    int spot,
                    float turn = 0.0f);

// Where an object is to be drawn that somebody holds: stage_from_object. palm: of
// state.hand in the holder's final pose (human::ActorFromPalm).
Pose DrawnPose(const ObjectModel& model,
               const ObjectState& state,
               const glm::mat4& stage_from_holder,
               const human::GripFrame& holder_from_palm);

// What is drawn of an object at stage_from_object: for each part of the prop its place,
// and whether it is there in this state (neither is what hangs on a part that is not).
void ComputeParts(const ObjectModel& model,
                  const ObjectState& state,
                  const Pose& stage_from_object,
                  std::span<glm::mat4> stage_from_part,
                  std::span<uint8_t> shown);

// Adds a lamp for each light that burns in the object's state, at a time of the drama.
void AddLamps(const Object& object,
              const ObjectState& state,
              const Pose& stage_from_object,
              double time,
              std::vector<light::Lamp>& lamps);
// What the emission of its meshes is multiplied with: as its lights burn, 1 without lights.
float GlowOf(const Object& object, const ObjectState& state, double time);

// Between two neighbouring ticks, alpha 0..1; current where it has gone elsewhere.
ObjectState Interpolate(const ObjectState& previous, const ObjectState& current, float alpha);

Pose Mix(const Pose& a, const Pose& b, float weight);
glm::mat4 ToMatrix(const Pose& pose);

}  // namespace lararium::stage
