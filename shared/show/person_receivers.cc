#include "shared/show/person_receivers.h"

#include <glm/gtc/quaternion.hpp>
#include <map>

#include "shared/human/skinning.h"

namespace lararium::show {

PersonReceivers::PersonReceivers(std::span<const human::LightTransfer::Receiver> receivers)
    : slots_(receivers.size()) {
  std::map<uint32_t, std::vector<size_t>> by_joint;
  for (size_t i = 0; i < receivers.size(); ++i) {
    by_joint[receivers[i].joint].push_back(i);
  }
  for (const auto& [joint, members] : by_joint) {
    groups_.push_back({joint, bind_points_.size(), bind_points_.size() + members.size()});
    for (const size_t member : members) {
      slots_[member] = static_cast<uint16_t>(bind_points_.size());
      bind_points_.push_back(receivers[member].position);
    }
  }
  for (std::vector<float>* values : {&x_, &y_, &z_, &turn_w_, &turn_x_, &turn_y_, &turn_z_}) {
    values->resize(receivers.size());
  }
}

void PersonReceivers::Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor) {
  for (const Group& group : groups_) {
    const glm::mat4 stage_from_bind = stage_from_actor * skin[group.joint];
    const glm::quat turn = human::ToDualQuaternion(stage_from_bind).real;
    for (size_t slot = group.begin; slot < group.end; ++slot) {
      const glm::vec3 point = stage_from_bind * glm::vec4(bind_points_[slot], 1.0f);
      x_[slot] = point.x;
      y_[slot] = point.y;
      z_[slot] = point.z;
      turn_w_[slot] = turn.w;
      turn_x_[slot] = turn.x;
      turn_y_[slot] = turn.y;
      turn_z_[slot] = turn.z;
    }
  }
}

}  // namespace lararium::show
