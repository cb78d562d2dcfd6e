#pragma once

// Affine transforms from foreign files, which may shear, mirror, be singular or not be finite.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "shared/human/skeleton.h"

namespace lararium::import {

// Says whether the matrix is finite, affine and invertible.
bool IsUsable(const glm::mat4& matrix);

glm::vec3 Apply(const glm::mat4& matrix, const glm::vec3& point);

// Mean scale of lengths: the cube root of the scale of volumes.
float ScaleOf(const glm::mat4& matrix);

// Decomposes to rotation, uniform scale and translation; ignores shear. A singular or mirroring
// matrix gives no rotation.
human::JointTransform Decompose(const glm::mat4& matrix);

// Normalises a vector; +Y if it has no direction.
glm::vec3 Unit(const glm::vec3& vector);

}  // namespace lararium::import
