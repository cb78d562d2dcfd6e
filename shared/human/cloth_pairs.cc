#include <algorithm>
#include <cmath>

#include "shared/human/cloth_data.h"

namespace lararium::human {
namespace {

constexpr float kPairMargin = 0.01f;  // metres, for what moves until the next search
// What lies closer together at rest is left to bending: pushed apart, a small crease
// would lock.
constexpr float kNearAtRest = 6.0f;  // contact distances

using Cell = std::array<int32_t, 3>;

// Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable
// Objects", VMV 2003.
uint32_t Hash(const Cell& cell) {
  return static_cast<uint32_t>(cell[0]) * 73856093u ^ static_cast<uint32_t>(cell[1]) * 19349663u ^
         static_cast<uint32_t>(cell[2]) * 83492791u;
}

// The slot of a cell, or the free one where it would be.
uint32_t SlotOf(const Cell& cell, const ClothGrid& grid) {
  const auto mask = static_cast<uint32_t>(grid.slots.size() - 1);
  uint32_t slot = Hash(cell) & mask;
  while (grid.slots[slot] != ClothGrid::kFree && grid.cells[grid.slots[slot]] != cell) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

uint32_t FindOrAddCell(const Cell& cell, ClothGrid& grid) {
  uint32_t& slot = grid.slots[SlotOf(cell, grid)];
  if (slot == ClothGrid::kFree) {
    slot = static_cast<uint32_t>(grid.cells.size());
    grid.cells.push_back(cell);
  }
  return slot;
}

// Sorts the particles by cell (counting sort).
void FillGrid(const std::vector<Float4>& positions, float cell_size, ClothGrid& grid) {
  const float inverse = 1.0f / cell_size;
  std::fill(grid.slots.begin(), grid.slots.end(), ClothGrid::kFree);
  std::fill(grid.starts.begin(), grid.starts.end(), 0u);
  grid.cells.clear();
  for (size_t i = 0; i < positions.size(); ++i) {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = static_cast<int32_t>(std::floor(positions[i].lanes[axis] * inverse));
    }
    grid.cell_of[i] = FindOrAddCell(cell, grid);
    ++grid.starts[grid.cell_of[i]];
  }
  uint32_t sum = 0;
  for (uint32_t& start : grid.starts) {
    sum += start;
    start = sum;
  }
  for (size_t i = positions.size(); i-- > 0;) {
    grid.particles[--grid.starts[grid.cell_of[i]]] = static_cast<uint32_t>(i);
  }
}

void AddPair(const ClothModel::Data& model, uint32_t i, uint32_t j, ClothState::Data& state) {
  const Float4 apart = state.positions[j] - state.positions[i];
  const float reach = model.contact_distance + kPairMargin;
  if (Dot(apart, apart) >= reach * reach || state.pairs.size() == state.pairs.capacity() ||
      model.inverse_mass[i] + model.inverse_mass[j] == 0.0f) {
    return;
  }
  const Float4 at_rest = model.rest[j] - model.rest[i];
  const float near = kNearAtRest * model.contact_distance;
  const bool is_same = model.cloth_of[i] == model.cloth_of[j];
  const float square = Dot(at_rest, at_rest);
  if (is_same && square < near * near) {
    return;
  }
  state.pairs.push_back({i, j, std::min(model.contact_distance, std::sqrt(square))});
}

std::span<const uint32_t> ParticlesIn(uint32_t cell, const ClothGrid& grid) {
  return std::span<const uint32_t>(grid.particles)
      .subspan(grid.starts[cell], grid.starts[cell + 1] - grid.starts[cell]);
}

}  // namespace

size_t SlotCount(size_t particle_count) {
  size_t slots = 64;
  while (slots < 2 * particle_count) {
    slots *= 2;
  }
  return slots;
}

void FindPairs(const ClothModel::Data& model, ClothState::Data& state) {
  state.pairs.clear();
  if (model.contact_distance <= 0.0f) {
    return;
  }
  ClothGrid& grid = state.grid;
  FillGrid(state.positions, 2.0f * (model.contact_distance + kPairMargin), grid);
  for (uint32_t c = 0; c < grid.cells.size(); ++c) {
    const std::span<const uint32_t> own = ParticlesIn(c, grid);
    for (size_t k = 0; k < own.size(); ++k) {
      for (size_t l = k + 1; l < own.size(); ++l) {
        AddPair(model, own[k], own[l], state);
      }
    }
    // Half of the 26 neighbours: the others find this one.
    for (int n = 14; n < 27; ++n) {
      const Cell& at = grid.cells[c];
      const uint32_t other =
          grid.slots[SlotOf({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1}, grid)];
      if (other == ClothGrid::kFree) {
        continue;
      }
      for (const uint32_t i : own) {
        for (const uint32_t j : ParticlesIn(other, grid)) {
          AddPair(model, i, j, state);
        }
      }
    }
  }
}

}  // namespace lararium::human
