#pragma once

// The cloth of one person: extended position-based dynamics.
//
// Each particle obeys Newton's laws; edges (stretch), hinges (bend), the body and
// the floor move it as constraints of given compliance: XPBD (Macklin, Mueller &
// Chentanez, "XPBD: Position-Based Simulation of Compliant Constrained Dynamics",
// MIG 2016), one iteration in each of many small steps (Macklin et al., "Small
// Steps in Physics Simulation", SCA 2019). A hinge bends by the chord of its angle,
// 2 sin(angle / 2), which is linear in the positions (Bergou et al., "A Quadratic
// Bending Model for Inextensible Surfaces", SGP 2006). No particle can be further
// from the nearest pin, along the cloth, than the cloth is long (Kim, Chentanez &
// Mueller-Fischer, "Long Range Attachments", SCA 2012).
//
// Frame: particles live in stage axes about a point near the actor and in the
// actor's metres, so that a skirt feels its wearer start, turn and stop, and a
// small-scale person's cloth hangs as at full size. Everything handed in and out is
// in the actor or the stage frame, as it says.
//
// Time: a clock of its own, 120 beats a second, each of one to four steps; poses
// between two frames are interpolated, and what is drawn is the last beat, moved on to
// the frame. The motion thus hardly depends on the frame rate, and is bit for bit the
// same for the same input.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/human.h"

namespace lararium::human {

// Moving air. Its gusts are a function of place, time and seed alone.
struct Wind {
  glm::vec3 velocity = glm::vec3(0.0f);  // mean, m/s, stage frame
  float gust = 0.4f;                     // standard deviation, as a share of the mean
  uint64_t seed = 1;
};

// From near to far. Changing it never makes the cloth jump.
enum class ClothDetail : uint8_t {
  kFull,     // four steps a beat
  kReduced,  // two
  kCoarse,   // one, without touching itself
  kSkinned   // plain skin: costs no simulation
};

// What no file says; the same for all cloths of a person.
struct ClothSettings {
  float gravity = 9.81f;     // m/s^2
  float air_density = 1.2f;  // kg/m^3
  float damping = 1.0f;      // 1/s, of the motion relative to the body
  bool drops_loose = false;  // pieces that no pin holds fall; false: they stay with the skin
};

class ClothModel;

// The moving part. A copy is a snapshot: stepped alike, both stay equal.
class ClothState {
 public:
  explicit ClothState(const ClothModel& model);
  ClothState(const ClothState& other);
  ClothState& operator=(const ClothState& other);
  ClothState(ClothState&&) noexcept;
  ClothState& operator=(ClothState&&) noexcept;
  ~ClothState();

  // Of Human::cloths[cloth], as to be drawn: metres, actor frame of the latest step.
  std::span<const glm::vec3> particles(size_t cloth) const;

  struct Data;
  Data& data() { return *data_; }
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

// What stays the same: built once for a person, then shared by all threads.
class ClothModel {
 public:
  // human is valid (Human::Validate).
  explicit ClothModel(const Human& human, const ClothSettings& settings = {});
  ClothModel(ClothModel&&) noexcept;
  ClothModel& operator=(ClothModel&&) noexcept;
  ~ClothModel();

  size_t cloth_count() const;
  size_t particle_count() const;  // of all cloths

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

// One frame of one person. Allocates nothing.
struct ClothStep {
  std::span<const glm::mat4> actor_from_joint;   // the pose to be drawn, [joint]
  glm::mat4 stage_from_actor = glm::mat4(1.0f);  // rigid, or with one scale
  float elapsed = 0.0f;                          // seconds since the last step
  float floor_height = 0.0f;                     // metres, y in the stage frame
  Wind wind = {};
  ClothDetail detail = ClothDetail::kFull;
};

struct ClothReport {
  bool jumped = false;  // a cut, a seek or a teleport: it was settled anew
  bool reset = false;   // a particle was lost: all went back to the skin
};

// Moves the cloth to the pose. The first step, one of more than a quarter of a second
// or of negative time, and one in which the body leaps further than people can move,
// carry the cloth along with the actor and settle it (SettleCloth). Input that is not
// finite leaves the cloth where it was.
ClothReport StepCloth(const ClothModel& model, const ClothStep& step, ClothState& state);

// Lets the cloth fall into place at a pose that holds still, until no particle moves
// faster than 2 cm/s but for at most `seconds` of its own time.
void SettleCloth(const ClothModel& model, const ClothStep& step, float seconds, ClothState& state);

// The drawn mesh of Human::cloths[cloth] (mesh: Human::meshes[Cloth::mesh]): bound
// vertices follow the particles, the others are plain skin (skin: as
// ComputeSkinMatrices gives it). Metres, actor frame.
void DrapeMesh(const ClothModel& model,
               const ClothState& state,
               size_t cloth,
               const SkinnedMesh& mesh,
               std::span<const glm::mat4> skin,
               std::span<glm::vec3> positions,
               std::span<glm::vec3> normals);

}  // namespace lararium::human
