#pragma once

// A sheet of cloth: flat panels of threads that are sewn together, with positions in space.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace lararium::import {

using Triangle = std::array<uint32_t, 3>;

// Vertices are points of the panels; vertices that are sewn together share one particle.
struct Sheet {
  // The arrays of vertices.
  std::vector<glm::vec2> flat;  // Metres on the panel: across, down.
  std::vector<uint8_t> panel;
  std::vector<uint32_t> particle;
  // The arrays of particles.
  std::vector<glm::vec3> positions;  // metres, actor frame
  std::vector<float> weights;        // [particle][joint_count]; empty until they are set.
  size_t joint_count = 0;

  std::vector<Triangle> triangles;  // Indices of vertices, counter-clockwise from outside.

  Triangle Particles(const Triangle& t) const {
    return {particle[t[0]], particle[t[1]], particle[t[2]]};
  }
  std::vector<Triangle> ParticleTriangles() const;
  std::span<float> WeightsOf(size_t p) { return {&weights[p * joint_count], joint_count}; }
  std::span<const float> WeightsOf(size_t p) const {
    return {&weights[p * joint_count], joint_count};
  }
};

// A grid of columns x rows vertices. AddPanel returns its first vertex; vertex (column, row) is
// first + row * columns + column. `mirrored` puts the outside on the other side.
struct GridPanel {
  size_t columns = 2;
  size_t rows = 2;
  bool mirrored = false;
  std::function<glm::vec2(size_t column, size_t row)> flat;
  std::function<glm::vec3(size_t column, size_t row)> place;
};
uint32_t AddPanel(Sheet& sheet, const GridPanel& grid, uint8_t panel);

// Sews pairs of vertices together; the particle of a seam is at the mean of the joined ones.
void Sew(Sheet& sheet, std::span<const std::array<uint32_t, 2>> pairs);

// Splits every triangle in four. `parents` gets, for each particle of the result, the two
// particles of `sheet` between which it is (the same one twice for an old particle).
Sheet Subdivided(const Sheet& sheet, std::vector<std::array<uint32_t, 2>>* parents = nullptr);

// Panels of vertices in a woven band have this bit set.
inline constexpr uint8_t kBand = 0x80;

// Doubles the vertices along the borders of bands, so that their colour ends sharply. `inside`
// decides for a triangle from its panel and the centroid of its corners on it.
void MarkBands(Sheet& sheet,
               const std::function<bool(uint8_t panel, const glm::vec2& middle)>& inside);

// Removes vertices without triangles; keeps all particles.
void DropUnusedVertices(Sheet& sheet);

// Unit outward normal of each particle.
std::vector<glm::vec3> Normals(std::span<const glm::vec3> positions,
                               std::span<const Triangle> triangles);

// Neighbours of each particle along edges.
std::vector<std::vector<uint32_t>> NeighboursOf(size_t count, std::span<const Triangle> triangles);

// Edges (pairs of particles) with only one triangle: hems and openings.
std::vector<std::array<uint32_t, 2>> OpenEdges(std::span<const Triangle> triangles);

}  // namespace lararium::import
