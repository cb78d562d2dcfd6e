#pragma once

// How actors use an object: a smart object, which describes its own interaction features (Kallmann
// & Thalmann, "Modeling Objects for Interaction Tasks", EGCAS 1998). Read from NAME.object.json
// (docs/file-formats.md).

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

// A part that turns or slides. Joint values are in radians or metres.
struct ObjectJoint {
  enum class Kind : uint8_t { kHinge, kSlider };

  int part = 0;  // Index into Prop::parts.
  Kind kind = Kind::kHinge;
  glm::vec3 axis = {0.0f, 1.0f, 0.0f};  // Unit vector, part frame.
  float lower = 0.0f;
  float upper = 0.0f;
  float rest = 0.0f;  // Value at the start.
};

// A part that is shown only in some states, such as a flame or a filling.
struct ShownPart {
  int part = 0;         // Index into Prop::parts.
  uint32_t states = 0;  // Bit i: shown in state i.
};

// Pose in which a hand holds the object. Hand frame, the same for both hands: origin in the middle
// of the palm's surface, -Z towards the fingertips, -Y out of the palm.
struct Grip {
  std::string name;
  int part = -1;  // Part that the grip moves with; -1: the object as a whole.
  Pose part_from_hand;
  std::array<bool, 2> fits = {true, true};  // Allowed hands: [human::kRight], [human::kLeft].
  human::HandPose hand_pose = human::HandPose::kCylinder;
};

// Where an actor stands to use the object. Object frame, on the ground, metres.
struct ApproachPlace {
  std::string name;
  glm::vec2 position = glm::vec2(0.0f);  // (x, z)
  float heading = 0.0f;                  // Radians about +Y; 0 faces the object's -Z.
};

// Where one object can be put down.
struct Spot {
  int part = -1;        // Part that carries the spot; -1: the object as a whole.
  Pose part_from_spot;  // Frame of an object that stands on the spot.
  int place = -1;  // Index into ObjectUse::places from which it is reached; -1: from anywhere near.
};

struct Surface {
  std::string name;
  std::vector<Spot> spots;
};

// Where actors must not walk: a convex outline of (x, z), object frame.
struct Footprint {
  std::vector<glm::vec2> outline;  // 3..12 corners; empty: blocks nothing.
  uint32_t states = ~0u;           // Bit i: blocks in state i. A door blocks only when shut.
};

// The grip (index into ObjectUse::grips) of each hand: [human::kRight], [human::kLeft]; -1: the
// hand is not used.
using HandGrips = std::array<int, 2>;
inline constexpr HandGrips kNoHands = {-1, -1};

// A sound that is heard during an action.
struct ActionSound {
  std::string name;  // Name of a sound of the project; empty: silent.
  float begin = 0.0f;
  float end = 1e9f;  // Begin and end in seconds of the action.
  bool loops = false;
  float gain_db = 0.0f;
};

// A sound that loops while the object is in some states, such as the crackle of a flame.
struct StateSound {
  std::string name;
  uint32_t states = ~0u;                 // Bit i: heard in state i.
  glm::vec3 position = glm::vec3(0.0f);  // Object frame.
  float gain_db = 0.0f;
};

// A surface of an object on which an actor can sit down.
struct ObjectSeat {
  glm::vec3 position = glm::vec3(0.0f);  // Point of the surface below the hips, object frame.
  float heading = 0.0f;
};

struct ObjectAction {
  // Moves a joint to a value during seconds begin..end of the action.
  struct Move {
    int joint = 0;
    float to = 0.0f;
    float begin = 0.0f;
    float end = 0.0f;
  };
  // Key of a path. If the object is not held: offset of the hands from their grips, object frame.
  // If it is held: pose of the object in the holder's frame (see Carry).
  struct Key {
    float time = 0.0f;
    Pose pose;
  };

  std::string name;
  uint32_t from = ~0u;    // Bit i: may begin in state i.
  int to = -1;            // State afterwards; -1: no change.
  bool held = false;      // The actor holds the object and stays where it is.
  uint32_t places = ~0u;  // Bit i: possible at approach place i.
  HandGrips hands = kNoHands;
  float duration = 1.0f;  // Seconds.
  float release = 1e9f;   // Seconds of the action after which the hands let go.
  std::vector<Move> moves;
  std::vector<Key> path;  // Ascending times.
  std::string clip;       // Clip that the actor plays meanwhile; empty: none.
  ActionSound sound;
  std::optional<ObjectSeat> seat;  // The actor sits down there and stays until its next task.
};

// How a portable object is carried: with the hands on it, in the pose holder_from_object (actor
// frame of a person 1.7 m tall, scaled to the carrier). Without this pose it hangs in one hand.
struct Carry {
  HandGrips hands = kNoHands;
  std::optional<Pose> holder_from_object;
};

// A spherical light, such as a flame or embers, that moves with a part.
struct ObjectLight {
  std::string name;
  int part = -1;                         // -1: the object as a whole.
  glm::vec3 position = glm::vec3(0.0f);  // Part frame.
  glm::vec3 colour = glm::vec3(1.0f);    // Linear RGB of luminance 1.
  // Irradiance of a surface one metre away that faces the light. At pi, a white wall there is as
  // bright as white in an image of gain 1.
  float intensity = 0.0f;
  float radius = 0.05f;   // Metres.
  float flicker = 0.0f;   // 0 (steady) to 1 (strong); see light::Flicker.
  uint32_t states = ~0u;  // Bit i: burns in state i.
};

struct ObjectUse {
  static constexpr size_t kMaxLights = 4;
  static constexpr size_t kMaxJoints = 4;
  static constexpr size_t kMaxStates = 16;
  static constexpr size_t kMaxPlaces = 8;
  static constexpr size_t kMaxGrips = 16;
  static constexpr size_t kMaxActions = 32;
  static constexpr size_t kMaxSpots = 32;  // Spots of all surfaces together.
  static constexpr size_t kMaxKeys = 32;   // Limit of `moves` and of `path` of an action.
  static constexpr size_t kMaxSounds = 8;  // Limit of `sounds`.

  std::vector<ObjectJoint> joints;
  std::vector<ShownPart> shown;
  std::vector<ObjectLight> lights;
  std::vector<Grip> grips;
  std::vector<ApproachPlace> places;
  std::vector<Surface> surfaces;
  std::vector<std::string> states = {"as is"};  // The first is the initial state.
  std::vector<ObjectAction> actions;
  std::vector<StateSound> sounds;
  Footprint footprint;
  std::optional<Carry> carry;  // None: the object cannot be carried.
  int capacity = 1;            // How many actors may use it at once.
  // Where the first waiting actor stands; each further one stands one queue_step on. None: behind
  // the first place.
  std::optional<ApproachPlace> queue;
  glm::vec2 queue_step = {0.0f, -0.8f};  // Object frame, metres.

  // Indices; -1: there is none of this name.
  int FindState(std::string_view name) const;
  int FindAction(std::string_view name) const;
  int FindGrip(std::string_view name) const;
};

// Error messages begin with `where` and name the field.
Result<ObjectUse> ParseObjectUse(std::string_view text, const Prop& prop, const std::string& where);

// Bounding box of a part's meshes, part frame. If there are no meshes, lower > upper.
struct PartBounds {
  glm::vec3 lower = glm::vec3(1e9f);
  glm::vec3 upper = glm::vec3(-1e9f);
};

// A prop with its use: the data that all objects of one kind share. Immutable except for light().
class ObjectModel {
 public:
  // If prop.use is empty, the object is scenery: it cannot be used, and its bounds block walkers.
  static Result<std::shared_ptr<ObjectModel>> Create(Prop prop, const std::string& where);

  const Prop& prop() const { return prop_; }
  // Mutable so that show::TakeLight can move the transfer vectors elsewhere.
  human::LightTransfer& light() { return prop_.light; }
  const ObjectUse& use() const { return use_; }
  const PartBounds& bounds(int part) const { return part_bounds_[static_cast<size_t>(part)]; }
  // Bounds of all parts at rest, object frame.
  glm::vec3 lower() const { return lower_; }
  glm::vec3 upper() const { return upper_; }
  glm::vec3 centre() const { return 0.5f * (lower_ + upper_); }

 private:
  ObjectModel() = default;

  Prop prop_;
  ObjectUse use_;
  std::vector<PartBounds> part_bounds_;  // Parallel to Prop::parts.
  glm::vec3 lower_ = glm::vec3(0.0f);
  glm::vec3 upper_ = glm::vec3(0.0f);
};

}  // namespace lararium::stage
