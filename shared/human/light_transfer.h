#pragma once

// How a person's surface answers to distant light: the transfer vectors of
// precomputed radiance transfer (Sloan, Kautz & Snyder, SIGGRAPH 2002) at several key
// poses, and what it takes to go from those to any other pose. shared/light computes
// with it; show brings the two together.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/skeleton.h"

namespace lararium::human {

struct SkinnedMesh;

struct LightTransfer {
  static constexpr size_t kMaxKeyPoses = 8;
  static constexpr size_t kMaxBlockers = 256;
  static constexpr size_t kMaxReceivers = 1024;

  // Stands for a piece of the body where it keeps light off something.
  struct Blocker {
    uint32_t joint = 0;
    glm::vec3 centre = glm::vec3(0.0f);  // bind pose, actor frame
    float radius = 0.05f;                // metres
  };
  // Where the light that is left by all blockers is worked out, just off the surface.
  struct Receiver {
    uint32_t joint = 0;
    glm::vec3 position = glm::vec3(0.0f);  // bind pose, actor frame
  };
  // Of the skinned mesh of the same index.
  struct Mesh {
    // Between which receivers a vertex lies, and how much it takes of each: in 1/255,
    // sum 255, the largest first.
    std::vector<std::array<uint16_t, 4>> receivers;
    std::vector<std::array<uint8_t, 4>> weights;
    // [key pose][vertex][channel][coefficient]: irradiance for radiance given by the same
    // spherical harmonic in the bind pose's axes, which turn with the vertex; in units of
    // scale.
    std::vector<int8_t> coefficients;
    std::vector<float> scale;  // [key pose][vertex]
    // Where the mesh is a sheet whose back can be seen, else empty: of each vertex's back, the
    // share of unshadowed light that arrives there, for each channel, in 1/255.
    std::vector<std::array<uint8_t, 3>> backs;
  };

  int count = 0;    // coefficients of each vector: 9, 16, 25 or 36
  int bounces = 0;  // reflections between surfaces that are in it
  std::vector<std::vector<JointTransform>> key_poses;  // parent_from_joint
  std::vector<Blocker> blockers;
  std::vector<Receiver> receivers;
  std::vector<Mesh> meshes;

  // What a mesh belongs to, as errors call it, and how large it must be.
  struct Surface {
    std::string name;
    size_t vertices = 0;
  };

  bool empty() const { return meshes.empty(); }
  Status Validate(const std::vector<Surface>& surfaces,
                  size_t joint_count,
                  const std::string& place) const;
  Status Validate(const std::vector<SkinnedMesh>& skinned,
                  size_t joint_count,
                  const std::string& place) const;
};

}  // namespace lararium::human
