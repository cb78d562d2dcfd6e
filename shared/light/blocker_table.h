#pragma once

// Log visibility past a ball and its exponential: Ren, Wang, Snyder, Tong, Liu, Sun, Zhou & Guo,
// "Real-time Soft Shadows in Dynamic Scenes using Spherical Harmonic Exponentiation", SIGGRAPH
// 2006. The visibility past many blockers is exp(sum of logs).
//
// Deviation from the paper: the paper takes the logarithm of the clamped eigenvalues of the matrix
// that multiplies with the visibility. Here the logarithm is the inverse of the exponential that is
// really computed, so that a single blocker gives the right result. A penalty limits logs that
// would grow without bound.

#include <array>
#include <vector>

#include "shared/core/check.h"
#include "shared/light/lanes.h"
#include "shared/light/sh_product.h"

namespace lararium::light {

// exp of f = dc + rest is e^dc (1 + rest / 2^p)^(2^p), with p squarings (DC isolation
// and scaling, Ren et al. 2006, section 4.2).
inline constexpr int kExpSquarings = 3;

// Computes the exponential for eight receivers. `result` may overlap `log`.
void ExpSh(const ShProductTable& products, const Lanes* log, Lanes* result);

// The log visibility past one ball about the direction of its centre, tabulated over the ball's
// apparent size.
class BlockerTable {
 public:
  // count: 9, 16 or 25. The table of each count is made once and then shared.
  static const BlockerTable& ForCount(int count);

  // The share of a ball of radius r at distance d between the receiver and its centre is q = r^2 /
  // (d^2 + r^2); it is 1/2 where the receiver touches the ball. Angular radii follow asin(r / d)
  // and approach kMaxAngularRadius smoothly as the receiver comes close. Inside the ball, the
  // higher bands fade to 0 at the centre.
  static double AngularRadius(double share);
  static constexpr double kMaxAngularRadius = 1.4;

  // factors[l]: the coefficient of Y_lm is factors[l] Y_lm(direction). Interpolated linearly
  // between kEntries values.
  using Factors = std::array<float, kLanes>;  // index: degree; zeros follow
  Factors At(float share) const;

  // Same as above for eight receivers with shares from 0 to 1; writes factors[l] for l <= Degree.
  template <int Degree>
  void At(const Lanes& share, Lanes* factors) const;

  int degree() const { return degree_; }

 private:
  explicit BlockerTable(int count);

  static constexpr int kEntries = 256;
  struct alignas(32) Entry {
    Factors value{};
    Factors slope{};  // difference to the next entry
  };

  int degree_;
  std::vector<Entry> entries_;
};

template <int Degree>
inline void BlockerTable::At(const Lanes& share, Lanes* factors) const {
  DCHECK(Degree == degree_);
  const Lanes position = share * static_cast<float>(kEntries);
  const IntLanes index = __builtin_convertvector(position, IntLanes);
  const Lanes rest = position - __builtin_convertvector(index, Lanes);
  const auto entry = [&](size_t i) -> const Entry& {
    return entries_[static_cast<size_t>(index[i])];
  };
  if constexpr (Degree <= 3) {
    // Four factors of the receivers i and i + 4 in one register.
    const Lanes rests[4] = {__builtin_shufflevector(rest, rest, 0, 0, 0, 0, 4, 4, 4, 4),
                            __builtin_shufflevector(rest, rest, 1, 1, 1, 1, 5, 5, 5, 5),
                            __builtin_shufflevector(rest, rest, 2, 2, 2, 2, 6, 6, 6, 6),
                            __builtin_shufflevector(rest, rest, 3, 3, 3, 3, 7, 7, 7, 7)};
    Lanes rows[4];
#pragma GCC unroll 4
    for (size_t i = 0; i < 4; ++i) {
      rows[i] = MultiplyAdd(rests[i], LoadHalves(entry(i).slope.data(), entry(i + 4).slope.data()),
                            LoadHalves(entry(i).value.data(), entry(i + 4).value.data()));
    }
    TransposeHalves(rows);
#pragma GCC unroll 4
    for (size_t l = 0; l <= static_cast<size_t>(Degree); ++l) {
      factors[l] = rows[l];
    }
  } else {
    Lanes rows[kLanes];
#pragma GCC unroll 8
    for (size_t i = 0; i < kLanes; ++i) {
      rows[i] =
          MultiplyAdd(Broadcast(rest[i]), Load(entry(i).slope.data()), Load(entry(i).value.data()));
    }
    Transpose(rows);
#pragma GCC unroll 6
    for (size_t l = 0; l <= static_cast<size_t>(Degree); ++l) {
      factors[l] = rows[l];
    }
  }
}

// Projection of the function that is 1 outside and 0 inside a ball of this angular radius about +Z:
// the coefficient of Y_l0.
double ZonalVisibility(int degree, double angular_radius);

}  // namespace lararium::light
