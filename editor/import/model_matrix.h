#pragma once

// Affine transforms as foreign files have them: they may shear, mirror, be flat or hold no
// numbers at all.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "shared/human/skeleton.h"

namespace lararium::import {

// Finite, affine and with an inverse.
bool IsUsable(const glm::mat4& matrix);

glm::vec3 Apply(const glm::mat4& matrix, const glm::vec3& point);

// By how much it makes lengths longer: the cube root of what it does to volumes.
float ScaleOf(const glm::mat4& matrix);

// As rotation, one scale and translation; what it shears is left out. One that is flat or
// mirrors has no rotation.
human::JointTransform Decompose(const glm::mat4& matrix);

// Of length 1; upwards where a vector has no direction.
glm::vec3 Unit(const glm::vec3& vector);

}  // namespace lararium::import
