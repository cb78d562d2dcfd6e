#pragma once

// What VRM adds to glTF: which node is which bone, the expressions of the face, what
// swings, who made it. Versions 0.x (extension VRM) and 1.0 (VRMC_vrm, VRMC_springBone).

#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/import/model_gltf.h"

namespace lararium::import {

struct Vrm {
  struct Expression {
    struct Bind {
      size_t mesh = 0;    // of the glTF
      size_t target = 0;  // of that mesh
      float weight = 1.0f;
    };
    std::string name;  // as in VRM 1.0: aa, ih, happy, blinkLeft, ...
    std::vector<Bind> binds;
  };
  // VRM moves the end of each bone once a frame, whatever the frame's length; values
  // are of its reference at 60 frames a second.
  struct Spring {
    std::string name;
    std::vector<size_t> nodes;  // each below the one before
    float stiffness = 1.0f;     // m/s towards the pose, once a frame
    float drag = 0.4f;          // share of the velocity lost in a frame
    float gravity = 0.0f;       // m/s downwards, once a frame
    float radius = 0.02f;       // metres
  };
  struct Collider {
    size_t node = 0;
    glm::vec3 a = glm::vec3(0.0f), b = glm::vec3(0.0f);  // of a capsule, node frame
    float radius = 0.0f;
  };

  std::map<std::string, size_t> bones;  // node of an H-Anim joint
  std::vector<Expression> expressions;
  std::vector<Spring> springs;
  std::vector<Collider> colliders;
  std::string credits;  // title, author, licence
};

// Nothing where the document is no VRM. Entries that make no sense are left out: the
// figure loads without them.
std::optional<Vrm> ReadVrm(const GltfDocument& document);

}  // namespace lararium::import
