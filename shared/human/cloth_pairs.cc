#include <algorithm>
#include <cmath>

#include "shared/human/cloth_data.h"

namespace lararium::human {
namespace {

constexpr float kPairMargin = 0.02f;  // Metres, for motion that differs from the prediction.
constexpr float kForesight = 0.5f * kBeatsBetweenPairs * kBeat;  // seconds
constexpr float kCellSize = 1.5f;  // Edge of a cell, as a multiple of the search distance.
// Particles that are closer than this in the rest shape form no pair, and bending alone keeps them
// apart. Pushing them apart would lock small creases. In contact distances.
constexpr float kNearAtRest = 6.0f;

// Indices along x, y and z, 21 bits each.
using Cell = uint64_t;

constexpr uint64_t kAxisMask = (uint64_t{1} << 21) - 1;

Cell MakeCell(int64_t x, int64_t y, int64_t z) {
  return (static_cast<uint64_t>(x) & kAxisMask) << 42 |
         (static_cast<uint64_t>(y) & kAxisMask) << 21 | (static_cast<uint64_t>(z) & kAxisMask);
}

// An invalid particle may have any coordinate, including NaN.
int64_t IndexOf(float scaled) {
  constexpr float kLimit = 1e6f;
  return scaled > -kLimit && scaled < kLimit ? static_cast<int64_t>(std::floor(scaled)) : 0;
}

Cell CellAt(const Float4& position, float inverse_size) {
  const Float4 scaled = position * inverse_size;
  return MakeCell(IndexOf(scaled.lanes[0]), IndexOf(scaled.lanes[1]), IndexOf(scaled.lanes[2]));
}

Cell Neighbour(Cell cell, int x, int y, int z) {
  const auto axis = [cell](int shift) { return static_cast<int64_t>(cell >> shift & kAxisMask); };
  return MakeCell(axis(42) + x, axis(21) + y, axis(0) + z);
}

// Returns the slot of a cell, or the free slot for it (Fibonacci hashing).
uint32_t SlotOf(Cell cell, const ClothGrid& grid) {
  const auto mask = static_cast<uint32_t>(grid.slots.size() - 1);
  uint32_t slot = static_cast<uint32_t>((cell * 0x9e3779b97f4a7c15ull) >> 40) & mask;
  while (grid.slots[slot] != ClothGrid::kFree && grid.cells[grid.slots[slot]] != cell) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

uint32_t FindOrAddCell(Cell cell, ClothGrid& grid) {
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
    grid.cell_of[i] = FindOrAddCell(CellAt(positions[i], inverse), grid);
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
  const Float4 at_rest = model.rest[j] - model.rest[i];
  const float near = kNearAtRest * model.contact_distance;
  const float square = Dot(at_rest, at_rest);
  const bool is_crease = model.cloth_of[i] == model.cloth_of[j] && square < near * near;
  const bool is_held = model.inverse_mass[i] + model.inverse_mass[j] == 0.0f;
  if (!is_crease && !is_held && state.pairs.size() < state.pairs.capacity()) {
    state.pairs.push_back({i, j, std::min(model.contact_distance, std::sqrt(square))});
  }
}

// reach is the square of the distance within which two particles form a pair.
inline void AddPairIfNear(
    const ClothModel::Data& model, uint32_t i, uint32_t j, float reach, ClothState::Data& state) {
  const Float4 apart = state.before[j] - state.before[i];
  if (Dot(apart, apart) < reach) {
    AddPair(model, i, j, state);
  }
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
  const float distance = model.contact_distance + kPairMargin;
  const float reach = distance * distance;
  // Predicted positions halfway to the next search. `before` is unused between steps.
  for (size_t i = 0; i < state.positions.size(); ++i) {
    state.before[i] = state.positions[i] + state.velocities[i] * kForesight;
  }
  FillGrid(state.before, kCellSize * distance, grid);
  for (uint32_t c = 0; c < grid.cells.size(); ++c) {
    const std::span<const uint32_t> own = ParticlesIn(c, grid);
    for (size_t k = 0; k < own.size(); ++k) {
      for (size_t l = k + 1; l < own.size(); ++l) {
        AddPairIfNear(model, own[k], own[l], reach, state);
      }
    }
    // Checks half of the 26 neighbours; the other half find this cell from their side.
    for (int n = 14; n < 27; ++n) {
      const Cell at = Neighbour(grid.cells[c], n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const uint32_t other = grid.slots[SlotOf(at, grid)];
      if (other == ClothGrid::kFree) {
        continue;
      }
      for (const uint32_t i : own) {
        for (const uint32_t j : ParticlesIn(other, grid)) {
          AddPairIfNear(model, i, j, reach, state);
        }
      }
    }
  }
}

}  // namespace lararium::human
