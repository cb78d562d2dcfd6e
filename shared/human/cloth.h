#pragma once

// Cloth simulation of one person by extended position-based dynamics.
//
// Each particle obeys Newton's laws. Edges (stretch), hinges (bend), the body and the floor act on
// it as constraints of given compliance: XPBD (Macklin, Mueller & Chentanez, "XPBD: Position-Based
// Simulation of Compliant Constrained Dynamics", MIG 2016), with one iteration in each of many
// small steps (Macklin et al., "Small Steps in Physics Simulation", SCA 2019). A hinge bends by the
// chord of its angle, 2 sin(angle / 2), which is linear in the positions (Bergou et al., "A
// Quadratic Bending Model for Inextensible Surfaces", SGP 2006). No particle can be further from
// its nearest pin than the distance along the cloth (Kim, Chentanez & Mueller-Fischer, "Long Range
// Attachments", SCA 2012).
//
// Frame: particles live in stage axes about a point near the actor, in the actor's metres. A skirt
// thus feels its wearer start, turn and stop, and the cloth of a person shown at a small scale
// hangs as at full size. Inputs and outputs are in the actor frame or in the stage frame, as each
// declaration says.
//
// Time: the simulation has its own clock of 120 beats a second, each of one to four steps. Body
// poses between two frames are interpolated; the cloth drawn is that of the last beat, moved on to
// the frame. The motion thus hardly depends on the frame rate, and equal input gives bit-identical
// results.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "shared/human/human.h"

namespace lararium::human {

// Moving air. Its gusts are a function of position, time and seed alone.
struct Wind {
  glm::vec3 velocity = glm::vec3(0.0f);  // mean, m/s, stage frame
  float gust = 0.4f;                     // standard deviation, as a share of the mean
  uint64_t seed = 1;
};

// Detail of the simulation, from near to far. Changing it never makes the cloth jump.
enum class ClothDetail : uint8_t {
  kFull,     // four steps a beat
  kReduced,  // two steps a beat
  kCoarse,   // one step a beat, without self-collision
  kSkinned   // plain skinning without simulation
};

// Parameters that no file stores; all cloths of a person share them.
struct ClothSettings {
  float gravity = 9.81f;     // m/s^2
  float air_density = 1.2f;  // kg/m^3
  float damping = 1.0f;      // 1/s, on the motion relative to the body
  // If true, pieces without a pin fall; if false, they stay with the skin.
  bool drops_loose = false;
};

class ClothModel;

// The state that changes over time. A copy is a snapshot: equal steps keep both equal.
class ClothState {
 public:
  explicit ClothState(const ClothModel& model);
  ClothState(const ClothState& other);
  ClothState& operator=(const ClothState& other);
  ClothState(ClothState&&) noexcept;
  ClothState& operator=(ClothState&&) noexcept;
  ~ClothState();

  // Particles of Human::cloths[cloth] as they are drawn: metres, in the actor frame of the latest
  // step.
  std::span<const glm::vec3> particles(size_t cloth) const;

  struct Data;
  Data& data() { return *data_; }
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

// The constant part: built once for a person, then shared by all threads.
class ClothModel {
 public:
  // Requires a valid human (Human::Validate).
  explicit ClothModel(const Human& human, const ClothSettings& settings = {});
  ClothModel(ClothModel&&) noexcept;
  ClothModel& operator=(ClothModel&&) noexcept;
  ~ClothModel();

  size_t cloth_count() const;
  size_t particle_count() const;  // Total over all cloths.

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
  float floor_height = 0.0f;                     // metres, the floor's y in the stage frame
  Wind wind = {};
  ClothDetail detail = ClothDetail::kFull;
};

struct ClothReport {
  bool jumped = false;  // After a cut, a seek or a teleport: the cloth was settled again.
  bool reset = false;   // A particle became invalid: all particles went back to the skin.
};

// Moves the cloth to the pose. Three kinds of step carry the cloth along with the actor and let it
// fall into place: the first step, a step of negative time or of more than a quarter of a second,
// and a step in which the body moves further than people can. If the input is not finite, the cloth
// stays where it was.
ClothReport StepCloth(const ClothModel& model, const ClothStep& step, ClothState& state);

// Computes the drawn mesh of Human::cloths[cloth]; `mesh` is Human::meshes[Cloth::mesh] and `skin`
// comes from ComputeSkinMatrices. Bound vertices follow the particles; the others are skinned.
// Positions are in metres in the actor frame.
void DrapeMesh(const ClothModel& model,
               const ClothState& state,
               size_t cloth,
               const SkinnedMesh& mesh,
               std::span<const glm::mat4> skin,
               std::span<glm::vec3> positions,
               std::span<glm::vec3> normals);

}  // namespace lararium::human
