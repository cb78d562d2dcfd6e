#pragma once

// Products of functions given by spherical harmonics: the projection of f g, whose
// coefficients are (f g)_k = sum_ij Gamma_ijk f_i g_j with the tripling coefficients
// Gamma_ijk, the integral of Y_i Y_j Y_k (Sloan, Kautz & Snyder 2002; Snyder, "Code
// Generation and Factoring for Fast Evaluation of Low-order Spherical Harmonic
// Products and Squares", Microsoft Research TR-2006-53).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/light/lanes.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::light {

// The tripling coefficients that are not zero, for one count, found by exact quadrature.
class ShProductTable {
 public:
  // count: 4, 9, 16, 25 or 36. Made once for each count, then shared and constant.
  static const ShProductTable& ForCount(int count);

  int count() const { return count_; }
  // How many terms g (a_i b_j + a_j b_i) all coefficients have together.
  size_t size() const { return terms_.size(); }

  // product = the projection of a b, for one receiver. All hold count() coefficients;
  // product overlaps neither.
  void Multiply(std::span<const float> a, std::span<const float> b, std::span<float> product) const;

  // The same for the eight receivers of a register.
  void Multiply(const Lanes* a, const Lanes* b, Lanes* product) const;
  // square = the projection of a a.
  void Square(const Lanes* a, Lanes* square) const;

 private:
  explicit ShProductTable(int count);

  // Adds gamma (a_i b_j + a_j b_i); where i = j, gamma is half of Gamma_iik.
  struct Term {
    float gamma = 0.0f;
    uint16_t i = 0, j = 0;
  };

  int count_;
  std::array<uint16_t, kShCount + 1> begin_{};  // of each coefficient's terms
  std::vector<Term> terms_;
};

// Light as the linear map that multiplies with it: coefficients of visibility to those
// of shadowed light. It takes as many bands of the light as matter, up to degree 5,
// whatever the count.
class LightMatrix {
 public:
  // Degree 4 (25) is the most that visibility may have.
  LightMatrix(const ShRgb& light, int count);

  int count() const { return count_; }
  // Of a channel: count x count, symmetric.
  const float* channel(int channel) const { return matrix_[static_cast<size_t>(channel)].data(); }

 private:
  int count_;
  std::array<std::array<float, 25 * 25>, 3> matrix_;
};

}  // namespace lararium::light
