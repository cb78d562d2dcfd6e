#pragma once

// The names of dyes and natural colours, which recipes and garments use.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/json_fields.h"

namespace lararium::import {

std::vector<std::string> DyeNames();

// Describes the name of a dye ("madder") or "#rrggbb" as linear RGB, for reading. The field may be
// missing.
void DescribeDye(Fields& fields, std::string_view key, glm::vec3& colour);

}  // namespace lararium::import
