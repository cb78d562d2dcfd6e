#pragma once

// Writes small figures as GLB for import tests: one triangle around each joint of the plain
// skeleton, in any axes and units, with arbitrary changes of the JSON.

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/json.h"
#include "shared/human/skeleton.h"

namespace lararium::test {

struct GlbFigure {
  Json json;
  std::vector<std::byte> binary;

  // Adds a view and an accessor of floats; returns the accessor.
  size_t AddFloats(const std::vector<float>& values, size_t components);
  // Adds bytes unchanged; returns the view.
  size_t AddBytes(const std::vector<std::byte>& bytes);
  std::vector<std::byte> Glb() const;
};

struct GlbFigureOptions {
  // The name of an H-Anim joint in the file.
  std::function<std::string(const std::string&)> name = [](const std::string& joint) {
    return joint;
  };
  glm::mat4 file_from_actor = glm::mat4(1.0f);  // A similarity.
};

// Node i is joint i of the skeleton; the last node has mesh 0 with skin 0.
GlbFigure MakeGlbFigure(const human::Skeleton& skeleton, const GlbFigureOptions& options = {});

}  // namespace lararium::test
