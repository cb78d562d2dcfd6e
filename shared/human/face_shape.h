#pragma once

// Named movements of a face and the vertex displacements behind them.

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::human {

struct SkinnedMesh;

// Displacements of some vertices in the bind pose. Weighted targets add up.
struct MorphTarget {
  struct Part {
    uint32_t mesh = 0;                       // index into Human::meshes
    std::vector<uint32_t> vertices;          // Vertex indices of the mesh, ascending.
    std::vector<glm::vec3> position_deltas;  // metres, parallel to vertices
    // Parallel to vertices; the summed normal is renormalised.
    std::vector<glm::vec3> normal_deltas;
  };

  std::string name;
  std::vector<Part> parts;  // A mesh has no more than one part.

  Status Validate(const std::vector<SkinnedMesh>& meshes, const std::string& where) const;
};

// A named movement of the face, from 0 (rest) to 1. Standard names are the visemes sil, PP, FF, TH,
// DD, kk, CH, SS, nn, RR, aa, E, ih, oh, ou, the expressions joy, sadness, anger, fear, disgust,
// surprise, and blink_l, blink_r. A character may have further shapes with other names.
struct FaceShape {
  struct Morph {
    uint32_t morph = 0;  // index into Human::morphs
    float weight = 1.0f;
  };
  // Turns a joint in its own frame, on top of the pose: rest * rotation.
  struct Turn {
    uint32_t joint = 0;
    glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  };

  std::string name;
  std::vector<Morph> morphs;
  std::vector<Turn> turns;

  Status Validate(size_t morph_count, size_t joint_count, const std::string& where) const;
};

}  // namespace lararium::human
