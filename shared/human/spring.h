#pragma once

// Hair, tassels and ends of belts: chains of joints that swing behind the head or the body that
// carries them.
//
// Each joint is a rigid stick to the next joint. A particle at the end of the stick is pulled to
// its animated position, falls, is braked, keeps its distance to the joint (XPBD, see cloth.h) and
// stays outside the body's capsules. The pull and the drag are integrated implicitly, so that no
// stiffness makes a chain unstable. Drag is relative to the chain's root: steady walking does not
// blow hair back.
//
// Frame: see cloth.h. Time: the simulation has its own clock of 240 steps a second.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "shared/human/human.h"

namespace lararium::human {

class SpringModel;

// The state that changes over time. A copy is a snapshot: equal steps keep both equal.
class SpringState {
 public:
  explicit SpringState(const SpringModel& model);
  SpringState(const SpringState& other);
  SpringState& operator=(const SpringState& other);
  SpringState(SpringState&&) noexcept;
  SpringState& operator=(SpringState&&) noexcept;
  ~SpringState();

  struct Data;
  Data& data() { return *data_; }
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

class SpringModel {
 public:
  // Requires a valid human (Human::Validate).
  explicit SpringModel(const Human& human);
  SpringModel(SpringModel&&) noexcept;
  SpringModel& operator=(SpringModel&&) noexcept;
  ~SpringModel();

  size_t chain_count() const;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

// One frame of one person. Allocates nothing.
struct SpringStep {
  glm::mat4 stage_from_actor = glm::mat4(1.0f);  // rigid, or with one scale
  float elapsed = 0.0f;                          // seconds since the last step
  bool simulated = true;                         // If false, the chains fade back to the animation.
};

// Turns the joints of the chains in `pose` (parent_from_joint), and updates their rows of
// actor_from_joint and those of their descendants. Call it after everything else that moves the
// person. Sudden jumps are treated as in StepCloth.
void StepSprings(const SpringModel& model,
                 const SpringStep& step,
                 SpringState& state,
                 std::span<JointTransform> pose,
                 std::span<glm::mat4> actor_from_joint);

}  // namespace lararium::human
