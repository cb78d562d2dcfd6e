#pragma once

// Light transfer at the vertices of surfaces that stand still (Sloan, Kautz & Snyder,
// SIGGRAPH 2002): what people at a key pose and things in a state have in common.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/bake/posed_surface.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::bake {

// One coefficient vector for each channel, [channel][light::kShCount].
using TransferVector = std::array<float, 3 * light::kShCount>;

// Where light arrives: the vertices of all meshes in a row, and after them once more those of
// two-sided meshes, seen from behind.
struct TransferSites {
  static constexpr size_t kNone = ~size_t{0};

  explicit TransferSites(std::vector<SurfaceMesh> surfaces);

  std::vector<SurfaceMesh> meshes;
  std::vector<size_t> first;       // site of each mesh's first vertex
  std::vector<size_t> first_back;  // of its back, or kNone
  size_t fronts = 0;               // how many sites are not backs
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // of the side
  std::vector<glm::vec3> albedo;

  size_t size() const { return positions.size(); }
};

struct TransferSolving {
  int count = 16;   // coefficients: 9, 16, 25 or 36
  int rays = 256;   // from each site
  int bounces = 2;  // reflections between surfaces; 0: shadowed direct light alone
};

struct SolvedTransfer {
  // Irradiance of each site for radiance given by each spherical harmonic, in the axes of the
  // meshes.
  std::vector<TransferVector> vectors;
  // Share of each site's rays that met the back of a one-sided surface: near 1 it lies inside
  // of something.
  std::vector<float> inside;
};

// The backs of one-sided surfaces reflect nothing. Deterministic, whatever the number of cores.
SolvedTransfer SolveTransfer(const TransferSites& sites,
                             const RayScene& rays,
                             const TransferSolving& solving);

// Marked vertices of a mesh take the mean of what their neighbours have that are not, and are not
// marked any more; then their neighbours, in as many passes. Marks and vectors: one for each
// vertex.
void SpreadTransfer(std::span<const uint32_t> indices,
                    int passes,
                    std::vector<bool> marks,
                    std::span<TransferVector> vectors);

// The share of an even sky's light, for each channel, that arrives by a vector; from 0 to 1.
glm::vec3 ShareOfEvenLight(const TransferVector& vector);

}  // namespace lararium::bake
