#include <algorithm>
#include <cmath>

#include "shared/human/cloth_data.h"

namespace lararium::human {
namespace {

constexpr float kPairMargin = 0.01f;  // metres, for what moves until the next search
// Neighbours in the cloth may come as close as they lie at rest.
constexpr float kRestShare = 0.9f;

using Cell = std::array<int32_t, 3>;

// Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable
// Objects", VMV 2003.
uint32_t BucketOf(const Cell& cell, uint32_t mask) {
  const uint32_t hash = static_cast<uint32_t>(cell[0]) * 73856093u ^
                        static_cast<uint32_t>(cell[1]) * 19349663u ^
                        static_cast<uint32_t>(cell[2]) * 83492791u;
  return hash & mask;
}

// Counting sort of the particles by bucket.
void FillBuckets(float cell_size, uint32_t mask, ClothState::Data& state) {
  const float inverse = 1.0f / cell_size;
  std::fill(state.bucket_starts.begin(), state.bucket_starts.end(), 0u);
  for (size_t i = 0; i < state.positions.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      state.cell_of[i][axis] =
          static_cast<int32_t>(std::floor(state.positions[i].lanes[axis] * inverse));
    }
    ++state.bucket_starts[BucketOf(state.cell_of[i], mask)];
  }
  uint32_t sum = 0;
  for (uint32_t& start : state.bucket_starts) {
    sum += start;
    start = sum;
  }
  for (size_t i = state.positions.size(); i-- > 0;) {
    state.cells[--state.bucket_starts[BucketOf(state.cell_of[i], mask)]] = static_cast<uint32_t>(i);
  }
}

void AddPair(const ClothModel::Data& model, uint32_t i, uint32_t j, ClothState::Data& state) {
  const Float4 apart = state.positions[j] - state.positions[i];
  const float reach = model.contact_distance + kPairMargin;
  if (Dot(apart, apart) >= reach * reach || state.pairs.size() == state.pairs.capacity() ||
      model.inverse_mass[i] + model.inverse_mass[j] == 0.0f) {
    return;
  }
  const float at_rest = kRestShare * Length(model.rest[j] - model.rest[i]);
  state.pairs.push_back({i, j, std::min(model.contact_distance, at_rest)});
}

// Pairs of i with particles of one cell; each pair of a cell with itself once.
void PairWithCell(const ClothModel::Data& model,
                  uint32_t i,
                  const Cell& cell,
                  bool is_own,
                  uint32_t mask,
                  ClothState::Data& state) {
  const uint32_t bucket = BucketOf(cell, mask);
  for (uint32_t k = state.bucket_starts[bucket]; k < state.bucket_starts[bucket + 1]; ++k) {
    const uint32_t j = state.cells[k];
    if (state.cell_of[j] == cell && (!is_own || j > i)) {
      AddPair(model, i, j, state);
    }
  }
}

}  // namespace

size_t BucketCount(size_t particle_count) {
  size_t buckets = 64;
  while (buckets < 2 * particle_count) {
    buckets *= 2;
  }
  return buckets;
}

void FindPairs(const ClothModel::Data& model, ClothState::Data& state) {
  state.pairs.clear();
  if (model.contact_distance <= 0.0f) {
    return;
  }
  const auto mask = static_cast<uint32_t>(state.bucket_starts.size() - 2);
  FillBuckets(model.contact_distance + kPairMargin, mask, state);
  for (uint32_t i = 0; i < state.positions.size(); ++i) {
    const Cell& own = state.cell_of[i];
    PairWithCell(model, i, own, true, mask, state);
    // Half of the 26 neighbours: the others find this one.
    for (int n = 14; n < 27; ++n) {
      PairWithCell(model, i, {own[0] + n % 3 - 1, own[1] + n / 3 % 3 - 1, own[2] + n / 9 - 1},
                   false, mask, state);
    }
  }
}

}  // namespace lararium::human
