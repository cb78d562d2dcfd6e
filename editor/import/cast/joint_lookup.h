#pragma once

// Finds joints that a skeleton must have.

#include <glm/vec3.hpp>
#include <string_view>

#include "shared/human/skeleton.h"

namespace lararium::import {

// RestPosition gives the position of a joint at rest, in the actor frame. The joint must exist.
size_t IndexOfJoint(const human::Skeleton& skeleton, std::string_view name);
glm::vec3 RestPosition(const human::Skeleton& skeleton, std::string_view name);

}  // namespace lararium::import
