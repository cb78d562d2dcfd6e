#pragma once

// Reads what VRM adds to glTF: the mapping of nodes to bones, facial expressions, springs and
// authors. Versions 0.x (extension VRM) and 1.0 (VRMC_vrm, VRMC_springBone).

#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/import/model/model_gltf.h"

namespace lararium::import {

struct Vrm {
  struct Expression {
    struct Bind {
      size_t mesh = 0;    // Index into the meshes of the glTF.
      size_t target = 0;  // Index of a morph target of that mesh.
      float weight = 1.0f;
    };
    std::string name;  // Name as in VRM 1.0: aa, ih, happy, blinkLeft, ...
    std::vector<Bind> binds;
  };
  // VRM moves the end of each bone once per frame, regardless of the frame time. These values
  // are those of its reference implementation at 60 frames per second.
  struct Spring {
    std::string name;
    std::vector<size_t> nodes;  // Each node is below the previous one.
    float stiffness = 1.0f;     // m/s towards the pose, per frame.
    float drag = 0.4f;          // Share of the velocity lost per frame.
    float gravity = 0.0f;       // m/s downwards, per frame.
    float radius = 0.02f;       // metres
  };
  struct Collider {
    size_t node = 0;
    glm::vec3 a = glm::vec3(0.0f), b = glm::vec3(0.0f);  // Ends of a capsule, node frame.
    float radius = 0.0f;
  };

  std::map<std::string, size_t> bones;  // Node of each H-Anim joint.
  std::vector<Expression> expressions;
  std::vector<Spring> springs;
  std::vector<Collider> colliders;
  std::string credits;  // Title, author, licence.
};

// Gives nullopt if the document is not a VRM. Invalid entries are left out; the figure loads
// without them.
std::optional<Vrm> ReadVrm(const GltfDocument& document);

}  // namespace lararium::import
