#include "editor/train/matching.h"

#include <algorithm>
#include <limits>
#include <numeric>

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace lararium::train {
namespace {

using vision::Descriptor;
using vision::kDescriptorSize;

constexpr size_t kRows = 2;     // Descriptors of a in a block that is held in registers.
constexpr size_t kColumns = 4;  // Descriptors of b in this block.
constexpr size_t kTile = 64;    // Descriptors of b that fit into the first-level cache.
constexpr uint32_t kFar = std::numeric_limits<uint32_t>::max();

// Descriptors widened to 16 bits, so that one instruction multiplies and adds pairs of values.
// Padded with zero descriptors to a multiple of the block size.
struct WideDescriptors {
  std::vector<int16_t> values;
  std::vector<uint32_t> squared_norms;
};

WideDescriptors Widen(std::span<const Descriptor> descriptors, size_t multiple) {
  const size_t padded = (descriptors.size() + multiple - 1) / multiple * multiple;
  WideDescriptors wide{std::vector<int16_t>(padded * kDescriptorSize),
                       std::vector<uint32_t>(padded)};
  for (size_t i = 0; i < descriptors.size(); ++i) {
    std::copy(descriptors[i].begin(), descriptors[i].end(),
              wide.values.begin() + static_cast<ptrdiff_t>(i * kDescriptorSize));
    for (const uint32_t value : descriptors[i]) {
      wide.squared_norms[i] += value * value;
    }
  }
  return wide;
}

using Dots = int32_t[kRows][kColumns];

#ifdef __AVX2__
// Compilers do not all find the instruction that multiplies and adds pairs.
void ComputeDots(const int16_t* a, const int16_t* b, Dots& dots) {
  constexpr size_t kLanes = sizeof(__m256i) / sizeof(int16_t);
  const auto load = [](const int16_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  };
  __m256i sums[kRows][kColumns] = {};
  for (size_t k = 0; k < kDescriptorSize; k += kLanes) {
    for (size_t r = 0; r < kRows; ++r) {
      const __m256i row = load(a + r * kDescriptorSize + k);
      for (size_t c = 0; c < kColumns; ++c) {
        const __m256i products = _mm256_madd_epi16(row, load(b + c * kDescriptorSize + k));
        sums[r][c] = _mm256_add_epi32(sums[r][c], products);
      }
    }
  }
  for (size_t r = 0; r < kRows; ++r) {
    const __m256i quarters = _mm256_hadd_epi32(_mm256_hadd_epi32(sums[r][0], sums[r][1]),
                                               _mm256_hadd_epi32(sums[r][2], sums[r][3]));
    const __m128i sum =
        _mm_add_epi32(_mm256_castsi256_si128(quarters), _mm256_extracti128_si256(quarters, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(dots[r]), sum);
  }
}
#else
void ComputeDots(const int16_t* a, const int16_t* b, Dots& dots) {
  for (size_t r = 0; r < kRows; ++r) {
    for (size_t c = 0; c < kColumns; ++c) {
      dots[r][c] = std::inner_product(a + r * kDescriptorSize, a + (r + 1) * kDescriptorSize,
                                      b + c * kDescriptorSize, 0);
    }
  }
}
#endif

// Calls visit(i, j, squared distance) for all pairs, in a fixed order.
template <typename Visit>
void ForAllPairs(std::span<const Descriptor> a, std::span<const Descriptor> b, Visit visit) {
  const WideDescriptors wide_a = Widen(a, kRows);
  const WideDescriptors wide_b = Widen(b, kColumns);
  for (size_t tile = 0; tile < b.size(); tile += kTile) {
    const size_t tile_end = std::min(tile + kTile, b.size());
    for (size_t i = 0; i < a.size(); i += kRows) {
      for (size_t j = tile; j < tile_end; j += kColumns) {
        Dots dots;
        ComputeDots(&wide_a.values[i * kDescriptorSize], &wide_b.values[j * kDescriptorSize], dots);
        for (size_t r = 0; r < std::min(kRows, a.size() - i); ++r) {
          for (size_t c = 0; c < std::min(kColumns, b.size() - j); ++c) {
            visit(i + r, j + c,
                  wide_a.squared_norms[i + r] + wide_b.squared_norms[j + c] -
                      2 * static_cast<uint32_t>(dots[r][c]));
          }
        }
      }
    }
  }
}

struct Nearest {
  uint32_t best = kFar;
  uint32_t second = kFar;
  uint32_t index = 0;

  void Add(uint32_t squared_distance, size_t candidate) {
    if (squared_distance < best) {
      second = best;
      best = squared_distance;
      index = static_cast<uint32_t>(candidate);
    } else if (squared_distance < second) {
      second = squared_distance;
    }
  }
  bool Distinct(float squared_ratio) const {
    return static_cast<float>(best) < squared_ratio * static_cast<float>(second);
  }
};

}  // namespace

std::vector<FeatureMatch> MatchDescriptors(std::span<const Descriptor> a,
                                           std::span<const Descriptor> b,
                                           float ratio) {
  std::vector<Nearest> of_a(a.size());
  std::vector<Nearest> of_b(b.size());
  ForAllPairs(a, b, [&](size_t i, size_t j, uint32_t squared_distance) {
    of_a[i].Add(squared_distance, j);
    of_b[j].Add(squared_distance, i);
  });
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < of_a.size(); ++i) {
    const Nearest& forward = of_a[i];
    if (forward.best != kFar && forward.Distinct(ratio * ratio) && of_b[forward.index].index == i &&
        of_b[forward.index].Distinct(ratio * ratio)) {
      matches.push_back({i, forward.index});
    }
  }
  return matches;
}

std::vector<uint32_t> StrongestFeatures(const vision::Features& features, size_t count) {
  std::vector<uint32_t> order(features.size());
  std::iota(order.begin(), order.end(), 0u);
  if (order.size() > count) {
    std::nth_element(order.begin(), order.begin() + static_cast<ptrdiff_t>(count), order.end(),
                     [&](uint32_t i, uint32_t j) {
                       const float a = features.keypoints[i].response;
                       const float b = features.keypoints[j].response;
                       return a != b ? a > b : i < j;
                     });
    order.resize(count);
    std::sort(order.begin(), order.end());
  }
  return order;
}

std::vector<uint32_t> NearestCenters(std::span<const Descriptor> queries,
                                     std::span<const Descriptor> centers) {
  std::vector<Nearest> nearest(queries.size());
  ForAllPairs(queries, centers, [&](size_t i, size_t j, uint32_t squared_distance) {
    nearest[i].Add(squared_distance, j);
  });
  std::vector<uint32_t> indices;
  indices.reserve(queries.size());
  for (const Nearest& n : nearest) {
    indices.push_back(n.index);
  }
  return indices;
}

}  // namespace lararium::train
