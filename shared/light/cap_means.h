#pragma once

// Zonal harmonics of uniform caps, which represent a disc or a ball of light in spherical
// harmonics.

#include <array>

#include "shared/light/spherical_harmonics.h"

namespace lararium::light {

// The mean of the Legendre polynomial P_l over a cap of opening a is a polynomial in u = sin^2(a /
// 2): sum_k (-1)^k C(l, k) C(l + k, k) u^k / (k + 1), from P_l(1 - 2u) as a sum of powers,
// integrated term by term. It is exact for points (u = 0) and for wide caps.
template <typename Number>
inline Number CapMean(int degree, const Number& u) {
  static constexpr std::array<std::array<float, kShDegree + 1>, kShDegree + 1> kPowers = {{
      {1},
      {1, -1},
      {1, -3, 2},
      {1, -6, 10, -5},
      {1, -10, 30, -35, 14},
      {1, -15, 70, -140, 126, -42},
  }};
  const auto& powers = kPowers[static_cast<size_t>(degree)];
  Number mean = u * 0.0f + powers[static_cast<size_t>(degree)];
  for (int k = degree - 1; k >= 0; --k) {
    mean = mean * u + powers[static_cast<size_t>(k)];
  }
  return mean;
}

}  // namespace lararium::light
