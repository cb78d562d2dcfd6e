#pragma once

// What a face can be told to do, and how its vertices follow.

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::human {

struct SkinnedMesh;

// Displacements of some vertices in the bind pose; weighted ones add up.
struct MorphTarget {
  struct Part {
    uint32_t mesh = 0;                       // index into Human::meshes
    std::vector<uint32_t> vertices;          // of it, ascending
    std::vector<glm::vec3> position_deltas;  // metres, parallel to vertices
    std::vector<glm::vec3> normal_deltas;    // likewise; the sum is normalised
  };

  std::string name;
  std::vector<Part> parts;  // at most one for each mesh

  Status Validate(const std::vector<SkinnedMesh>& meshes, const std::string& place) const;
};

// A named movement of the face, from 0 (rest) to 1. Names: the visemes sil, PP, FF,
// TH, DD, kk, CH, SS, nn, RR, aa, E, ih, oh, ou; the expressions joy, sadness, anger,
// fear, disgust, surprise; blink_l, blink_r; others as the figure has them.
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

  Status Validate(size_t morph_count, size_t joint_count, const std::string& place) const;
};

}  // namespace lararium::human
