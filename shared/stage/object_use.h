#pragma once

// How an object is used: a smart object, which knows its own interaction features
// (Kallmann & Thalmann, "Modeling Objects for Interaction Tasks", EGCAS 1998). Read
// from NAME.object.json; docs/file-formats.md says what a person writes there.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/hand_pose.h"
#include "shared/stage/prop.h"

namespace lararium::stage {

// A part that turns or slides. Its value is in radians or metres.
struct ObjectJoint {
  enum class Kind : uint8_t { kHinge, kSlider };

  int part = 0;  // index into Prop::parts
  Kind kind = Kind::kHinge;
  glm::vec3 axis = {0.0f, 1.0f, 0.0f};  // unit, part frame
  float lower = 0.0f;
  float upper = 0.0f;
  float rest = 0.0f;  // value at the beginning
};

// A part that is there only in some states: a flame, a filling.
struct ShownPart {
  int part = 0;
  uint32_t states = 0;  // bit i: in state i
};

// Where a hand holds. Hand frame: origin in the middle of the palm's surface, -Z
// towards the fingertips, -Y out of the palm; the same for both hands.
struct Grip {
  std::string name;
  int part = -1;  // that the grip moves with; -1: the object as a whole
  Pose part_from_hand;
  std::array<bool, 2> fits = {true, true};  // which hands, by side
  human::HandPose hand_pose = human::HandPose::kCylinder;
};

// Where somebody stands who uses the object. Object frame, on the ground.
struct ApproachPlace {
  std::string name;
  glm::vec2 position = glm::vec2(0.0f);  // x, z
  float heading = 0.0f;                  // radians about +Y; 0 faces the object's -Z
};

// Where something can be put down.
struct Spot {
  int part = -1;        // that carries it; -1: the object as a whole
  Pose part_from_spot;  // the frame of what stands there
  int place = -1;       // from where it is reached; -1: from wherever it is near
};

struct Surface {
  std::string name;
  std::vector<Spot> spots;
};

// Where people must not walk, x and z of a convex outline. Object frame.
struct Footprint {
  std::vector<glm::vec2> outline;  // 3..12 corners; empty: nothing is in the way
  uint32_t states = ~0u;           // bit i: in state i; a door blocks only when shut
};

// Hands on a thing, a grip for each, by side (human::kRight, human::kLeft); -1: that
// hand is free.
using HandGrips = std::array<int, 2>;
inline constexpr HandGrips kNoHands = {-1, -1};

// A sound that is heard while something is done with the object.
struct ActionSound {
  std::string name;  // of a sound of the project; empty: silent
  float begin = 0.0f;
  float end = 1e9f;  // seconds of the action
  bool loops = false;
  float gain_db = 0.0f;
};

// A sound that never ends while the object is in some states: a flame.
struct StateSound {
  std::string name;
  uint32_t states = ~0u;                 // bit i: in state i
  glm::vec3 position = glm::vec3(0.0f);  // object frame
  float gain_db = 0.0f;
};

struct ObjectAction {
  // A joint goes to a value while seconds begin..end of the action pass.
  struct Move {
    int joint = 0;
    float to = 0.0f;
    float begin = 0.0f;
    float end = 0.0f;
  };
  // At a time of the action the hands are this far from their grips (object frame);
  // of a held object: where the object is, in the holder's frame (see Carry).
  struct Key {
    float time = 0.0f;
    Pose pose;
  };
  struct Seat {
    glm::vec3 position = glm::vec3(0.0f);  // on its surface, below the hip joints; object frame
    float heading = 0.0f;
  };

  std::string name;
  uint32_t from = ~0u;    // bit i: may begin in state i
  int to = -1;            // state afterwards; -1: as before
  bool held = false;      // done with the object in the hand, wherever its holder is
  uint32_t places = ~0u;  // bit i: at approach place i
  HandGrips hands = kNoHands;
  float duration = 1.0f;  // seconds
  float release = 1e9f;   // seconds of the action after which the hands let go
  std::vector<Move> moves;
  std::vector<Key> path;  // times increase
  std::string clip;       // that the actor plays meanwhile; empty: none
  ActionSound sound;
  std::optional<Seat> seat;  // the actor sits down there and stays until its next task
};

// How a portable object is carried. With hands on it in the pose holder_from_object
// (actor frame of a person 1.7 m tall, scaled to whoever carries), or, without one,
// it hangs in the one hand.
struct Carry {
  HandGrips hands = kNoHands;
  std::optional<Pose> holder_from_object;
};

// A flame or embers: a ball of light that moves with a part.
struct ObjectLight {
  std::string name;
  int part = -1;                         // -1: the object as a whole
  glm::vec3 position = glm::vec3(0.0f);  // part frame
  glm::vec3 colour = glm::vec3(1.0f);    // linear RGB of luminance 1
  // Irradiance of a surface one metre away that faces it; pi makes a white wall there as
  // bright as white in an image of gain 1.
  float intensity = 0.0f;
  float radius = 0.05f;   // metres
  float flicker = 0.0f;   // 0 steady, 1 wild: light::Flicker
  uint32_t states = ~0u;  // bit i: it burns in state i
};

struct ObjectUse {
  static constexpr size_t kMaxLights = 4;
  static constexpr size_t kMaxJoints = 4;
  static constexpr size_t kMaxStates = 16;
  static constexpr size_t kMaxPlaces = 8;
  static constexpr size_t kMaxGrips = 16;
  static constexpr size_t kMaxActions = 32;
  static constexpr size_t kMaxSpots = 32;  // of all surfaces
  static constexpr size_t kMaxKeys = 32;   // of moves and path
  static constexpr size_t kMaxSounds = 8;  // of states

  std::vector<ObjectJoint> joints;
  std::vector<ShownPart> shown;
  std::vector<ObjectLight> lights;
  std::vector<Grip> grips;
  std::vector<ApproachPlace> places;
  std::vector<Surface> surfaces;
  std::vector<std::string> states = {"as is"};  // the first is that of the beginning
  std::vector<ObjectAction> actions;
  std::vector<StateSound> sounds;
  Footprint footprint;
  std::optional<Carry> carry;  // none: it stays where it is
  int capacity = 1;            // how many may use it at once
  // Who waits stands here, each further one step on. None: behind the places.
  std::optional<ApproachPlace> queue;
  glm::vec2 queue_step = {0.0f, -0.8f};  // object frame

  int FindState(std::string_view name) const;   // -1: none
  int FindAction(std::string_view name) const;  // -1: none
  int FindGrip(std::string_view name) const;    // -1: none
};

// place: what errors call the text; they name the field.
Result<ObjectUse> ParseObjectUse(std::string_view text, const Prop& prop, const std::string& place);

// Of one part's meshes, part frame; lower is above upper where it has none.
struct PartBounds {
  glm::vec3 lower = glm::vec3(1e9f);
  glm::vec3 upper = glm::vec3(-1e9f);
};

// A prop with its use: what all objects of one kind share. Immutable.
class ObjectModel {
 public:
  // Scenery when prop.use is empty: nobody uses it, its bounds are in the way.
  static Result<std::shared_ptr<ObjectModel>> Create(Prop prop, const std::string& place);

  const Prop& prop() const { return prop_; }
  // For who keeps the prop's transfer vectors elsewhere (show::TakeLight).
  human::LightTransfer& light() { return prop_.light; }
  const ObjectUse& use() const { return use_; }
  const PartBounds& bounds(int part) const { return part_bounds_[static_cast<size_t>(part)]; }
  // Of all parts at rest, object frame.
  glm::vec3 lower() const { return lower_; }
  glm::vec3 upper() const { return upper_; }
  glm::vec3 centre() const { return 0.5f * (lower_ + upper_); }

 private:
  ObjectModel() = default;

  Prop prop_;
  ObjectUse use_;
  std::vector<PartBounds> part_bounds_;  // parallel to Prop::parts
  glm::vec3 lower_ = glm::vec3(0.0f);
  glm::vec3 upper_ = glm::vec3(0.0f);
};

}  // namespace lararium::stage
