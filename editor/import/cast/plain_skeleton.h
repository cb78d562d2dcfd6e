#pragma once

// The skeleton of the plain figure, 1.72 m high, with joint names of H-Anim (ISO/IEC 19774) and
// segment lengths after Winter, "Biomechanics and Motor Control of Human Movement", figure 4.1.
// In the rest pose the arms hang 33 degrees out, and every joint frame is parallel to the
// actor's, so that a pose is a list of rotations about the axes of the actor.

#include <glm/vec3.hpp>
#include <string_view>

#include "shared/human/skeleton.h"

namespace lararium::import {

inline constexpr float kPlainHeight = 1.72f;  // metres

// Joints of the skirt of the tunic: six panels that hang from the hips.
inline constexpr const char* kSkirtJoints[6] = {"tunic_front_r", "tunic_side_r", "tunic_back_r",
                                                "tunic_back_l",  "tunic_side_l", "tunic_front_l"};

human::Skeleton PlainSkeleton();

// RestPosition gives the position of a joint at rest, in the actor frame. The joint must exist.
size_t IndexOfJoint(const human::Skeleton& skeleton, std::string_view name);
glm::vec3 RestPosition(const human::Skeleton& skeleton, std::string_view name);

}  // namespace lararium::import
