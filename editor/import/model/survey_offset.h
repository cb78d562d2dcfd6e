#pragma once

// Moves models in the coordinates of a survey, such as UTM, near the origin. There, millions of
// metres from it, a float counts in steps of half a metre.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace lararium::import {

// Whole kilometres to take off positions that are far from the origin for their extent; zero for
// others.
glm::dvec3 SurveyOffset(std::span<const glm::dvec3> positions);

// Takes the offset off the vertices in the text of an OBJ or PLY, whose numbers have all digits
// there; readers make floats of them. `extension` is lower case, with its dot. Gives what was
// taken off; zero, and leaves the text unchanged, for other models and for a PLY whose positions
// are floats.
glm::dvec3 TakeOffSurvey(const std::string& extension, std::vector<std::byte>& bytes);

}  // namespace lararium::import
