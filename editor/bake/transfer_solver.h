#pragma once

// Light transfer at the vertices of static surfaces (Sloan, Kautz & Snyder, SIGGRAPH 2002), for
// people at a key pose and for objects in a state.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/bake/posed_surface.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::bake {

// One vector of coefficients for each channel, [channel][light::kShCount].
using TransferVector = std::array<float, 3 * light::kShCount>;

// The sites that receive light: the vertices of all meshes in one list, then once more the
// vertices of two-sided meshes, seen from behind.
struct TransferSites {
  static constexpr size_t kNone = ~size_t{0};

  explicit TransferSites(std::vector<SurfaceMesh> surfaces);

  std::vector<SurfaceMesh> meshes;
  std::vector<size_t> first;  // Site of the first vertex of each mesh.
  // For each mesh, the site of the back of its first vertex, or kNone.
  std::vector<size_t> first_back;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // Normals of the side that the site is on.
  std::vector<glm::vec3> albedo;

  size_t size() const { return positions.size(); }
};

struct TransferSolving {
  int count = 16;   // coefficients: 9, 16, 25 or 36
  int rays = 256;   // Rays from each site.
  int bounces = 2;  // Reflections between surfaces; 0 gives shadowed direct light only.
};

struct SolvedTransfer {
  // For each site, its irradiance for radiance given by each spherical harmonic, in the axes of
  // the meshes.
  std::vector<TransferVector> vectors;
  // For each site, the share of its rays that hit the back of a one-sided surface; near 1 the
  // site lies inside an object.
  std::vector<float> inside;
};

// Backs of one-sided surfaces reflect nothing. Deterministic for any number of cores.
SolvedTransfer SolveTransfer(const TransferSites& sites,
                             const RayScene& rays,
                             const TransferSolving& solving);

// Gives each marked vertex of a mesh the mean of its unmarked neighbours and unmarks it, then
// continues with their neighbours, at most `passes` times. `marks` and `vectors` have one entry
// for each vertex.
void SpreadTransfer(std::span<const uint32_t> indices,
                    int passes,
                    std::vector<bool> marks,
                    std::span<TransferVector> vectors);

// The share of the light of a uniform sky that arrives through a vector, per channel, from 0 to
// 1.
glm::vec3 ShareOfEvenLight(const TransferVector& vector);

}  // namespace lararium::bake
