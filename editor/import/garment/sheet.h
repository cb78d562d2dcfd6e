#pragma once

// A sheet of cloth: flat panels of threads, sewn together, in some shape in space.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace lararium::import {

using Triangle = std::array<uint32_t, 3>;

// Vertices are places on panels; where panels are sewn together, several of them share
// one particle.
struct Sheet {
  // [vertex]
  std::vector<glm::vec2> flat;  // metres on the panel: across, down
  std::vector<uint8_t> panel;
  std::vector<uint32_t> particle;
  // [particle]
  std::vector<glm::vec3> positions;  // metres, actor frame
  std::vector<float> weights;        // [particle][joint_count]; empty before they are given
  size_t joint_count = 0;

  std::vector<Triangle> triangles;  // of vertices; anticlockwise from outside

  Triangle Particles(const Triangle& t) const {
    return {particle[t[0]], particle[t[1]], particle[t[2]]};
  }
  std::vector<Triangle> ParticleTriangles() const;
  std::span<float> WeightsOf(size_t p) { return {&weights[p * joint_count], joint_count}; }
  std::span<const float> WeightsOf(size_t p) const {
    return {&weights[p * joint_count], joint_count};
  }
};

// A grid of columns x rows vertices. Returns its first vertex; vertex (column, row) is
// that + row * columns + column. mirrored: the outside is the other side.
struct GridPanel {
  size_t columns = 2;
  size_t rows = 2;
  bool mirrored = false;
  std::function<glm::vec2(size_t column, size_t row)> flat;
  std::function<glm::vec3(size_t column, size_t row)> place;
};
uint32_t AddPanel(Sheet& sheet, const GridPanel& grid, uint8_t panel);

// Sews pairs of vertices together; each seam's particle lies amid what it joins.
void Sew(Sheet& sheet, std::span<const std::array<uint32_t, 2>> pairs);

// Every triangle in four. parents: of each particle of the result, the two of the
// given sheet that it lies between (the same one twice: it was there before).
Sheet Subdivided(const Sheet& sheet, std::vector<std::array<uint32_t, 2>>* parents = nullptr);

// Panels of vertices within a woven band have this bit set.
inline constexpr uint8_t kBand = 0x80;

// Doubles the vertices along the rims of bands, so that their colour ends sharply.
// inside: of a triangle, by its panel and the middle of its corners on it.
void MarkBands(Sheet& sheet,
               const std::function<bool(uint8_t panel, const glm::vec2& middle)>& inside);

// Vertices that no triangle has go; particles stay.
void DropUnusedVertices(Sheet& sheet);

// Unit, outward; of each particle.
std::vector<glm::vec3> Normals(std::span<const glm::vec3> positions,
                               std::span<const Triangle> triangles);

// Neighbours of each particle along edges.
std::vector<std::vector<uint32_t>> NeighboursOf(size_t count, std::span<const Triangle> triangles);

// Edges (as particles) that only one triangle has: hems and openings.
std::vector<std::array<uint32_t, 2>> OpenEdges(std::span<const Triangle> triangles);

}  // namespace lararium::import
