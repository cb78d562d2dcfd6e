#pragma once

// The points of one person at which light is evaluated, for a pose.

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/light_transfer.h"
#include "shared/light/receivers.h"

namespace lararium::show {

class PersonReceivers {
 public:
  explicit PersonReceivers(std::span<const human::LightTransfer::Receiver> receivers);

  // Receivers are ordered by joint. The slot is the index, in that order, of receivers[index].
  uint16_t slot(size_t index) const { return slots_[index]; }

  // Moves the receivers to a pose. Allocates nothing.
  void Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor);

  // Positions in the last pose, stage axes, and rotations from the bind pose; by slot.
  light::Points points() const { return {x_, y_, z_}; }
  light::Turns stage_from_bind() const { return {turn_w_, turn_x_, turn_y_, turn_z_}; }

 private:
  // Receivers that follow one joint, contiguous.
  struct Group {
    uint32_t joint = 0;
    size_t begin = 0;
    size_t end = 0;
  };

  std::vector<Group> groups_;
  std::vector<uint16_t> slots_;
  std::vector<glm::vec3> bind_points_;  // Actor frame, by slot.
  std::vector<float> x_, y_, z_;
  std::vector<float> turn_w_, turn_x_, turn_y_, turn_z_;
};

}  // namespace lararium::show
