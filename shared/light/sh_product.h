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

// The non-zero tripling coefficients for one count, computed by exact quadrature.
class ShProductTable {
 public:
  // count: 4, 9, 16, 25 or 36. The table of each count is made once and then shared.
  static const ShProductTable& ForCount(int count);

  int count() const { return count_; }
  // Total number of terms g (a_i b_j + a_j b_i) of all coefficients.
  size_t size() const { return terms_.size(); }

  // product = the projection of a b, for one receiver. All spans hold count() coefficients; product
  // overlaps neither input.
  void Multiply(std::span<const float> a, std::span<const float> b, std::span<float> product) const;

  // Same as above for the eight receivers of a register.
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
  std::array<uint16_t, kShCount + 1> begin_{};  // first term of each coefficient
  std::vector<Term> terms_;
};

// Light as the linear map from coefficients of visibility to those of shadowed light. It uses all
// bands of the light that matter, up to degree 5, for every count.
class LightMatrix {
 public:
  // Visibility may have at most degree 4 (25 coefficients).
  LightMatrix(const ShRgb& light, int count);

  int count() const { return count_; }
  // Matrix of a channel: count x count, symmetric.
  const float* channel(int channel) const { return matrix_[static_cast<size_t>(channel)].data(); }

 private:
  int count_;
  std::array<std::array<float, 25 * 25>, 3> matrix_;
};

}  // namespace lararium::light
