#pragma once

// Response of a person's surface to distant light: the transfer vectors of precomputed radiance
// transfer (Sloan, Kautz & Snyder, SIGGRAPH 2002) at several key poses, and the data that adapts
// them to other poses. shared/light does the computation; shared/show combines the two.

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

  // A sphere that represents a part of the body where it blocks light.
  struct Blocker {
    uint32_t joint = 0;
    glm::vec3 centre = glm::vec3(0.0f);  // bind pose, actor frame
    float radius = 0.05f;                // metres
  };
  // A point just off the surface at which the light that all blockers leave is evaluated.
  struct Receiver {
    uint32_t joint = 0;
    glm::vec3 position = glm::vec3(0.0f);  // bind pose, actor frame
  };
  // Data of the skinned mesh with the same index.
  struct Mesh {
    // The receivers between which a vertex lies and their weights, in 1/255 with the sum 255, the
    // largest first.
    std::vector<std::array<uint16_t, 4>> receivers;
    std::vector<std::array<uint8_t, 4>> weights;
    // [key pose][vertex][channel][coefficient]: irradiance under radiance given by the same
    // spherical harmonic in the bind pose's axes, which turn with the vertex. The unit is `scale`.
    std::vector<int8_t> coefficients;
    std::vector<float> scale;  // [key pose][vertex]
    // For a sheet whose back is visible, the share of unshadowed light that arrives at the back of
    // each vertex, for each channel, in 1/255. Empty for other meshes.
    std::vector<std::array<uint8_t, 3>> backs;
  };

  int count = 0;    // Coefficients of each vector: 9, 16, 25 or 36.
  int bounces = 0;  // Number of included reflections between surfaces.
  std::vector<std::vector<JointTransform>> key_poses;  // parent_from_joint
  std::vector<Blocker> blockers;
  std::vector<Receiver> receivers;
  std::vector<Mesh> meshes;

  // The surface of a mesh: its name in errors, and the vertex count that the mesh must have.
  struct Surface {
    std::string name;
    size_t vertices = 0;
  };

  bool empty() const { return meshes.empty(); }
  Status Validate(const std::vector<Surface>& surfaces,
                  size_t joint_count,
                  const std::string& where) const;
  Status Validate(const std::vector<SkinnedMesh>& skinned,
                  size_t joint_count,
                  const std::string& where) const;
};

}  // namespace lararium::human
