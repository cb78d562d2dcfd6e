#include "shared/light/spherical_harmonics.h"

#include <algorithm>
#include <cstdlib>
#include <glm/common.hpp>

#include "shared/core/check.h"
#include "shared/core/units.h"

namespace lararium::light {
namespace {

std::array<double, kShCount> MakeNormalisation() {
  std::array<double, kShCount> factors{};
  for (int l = 0; l <= kShDegree; ++l) {
    for (int m = -l; m <= l; ++m) {
      double square = (2.0 * l + 1.0) / (4.0 * kPi) * (m == 0 ? 1.0 : 2.0);
      for (int k = l - std::abs(m) + 1; k <= l + std::abs(m); ++k) {
        square /= k;  // (l-|m|)! / (l+|m|)!
      }
      factors[static_cast<size_t>(l * (l + 1) + m)] = std::sqrt(square);
    }
  }
  return factors;
}

// A band's matrix while it is computed: (2l+1)^2 numbers addressed by m and n.
class BandMatrix {
 public:
  explicit BandMatrix(int degree) : degree_(degree) {}
  int degree() const { return degree_; }
  double& operator()(int m, int n) { return values_[Index(m, n)]; }
  double operator()(int m, int n) const { return values_[Index(m, n)]; }

 private:
  size_t Index(int m, int n) const {
    return static_cast<size_t>((m + degree_) * (2 * degree_ + 1) + n + degree_);
  }

  int degree_;
  std::array<double, 121> values_;
};

// Degree 1 is a vector: m = -1, 0, 1 is y, z, x.
BandMatrix FirstBand(const glm::mat3& rotation) {
  constexpr int kAxis[3] = {1, 2, 0};
  BandMatrix first(1);
  for (int m = -1; m <= 1; ++m) {
    for (int n = -1; n <= 1; ++n) {
      first(m, n) = rotation[kAxis[n + 1]][kAxis[m + 1]];
    }
  }
  return first;
}

// P of Ivanic & Ruedenberg, table 2: products of degree 1 and the band below.
double P(const BandMatrix& first, const BandMatrix& below, int i, int m, int n) {
  const int l = below.degree() + 1;
  if (n == l) {
    return first(i, 1) * below(m, l - 1) - first(i, -1) * below(m, 1 - l);
  }
  if (n == -l) {
    return first(i, 1) * below(m, 1 - l) + first(i, -1) * below(m, l - 1);
  }
  return first(i, 0) * below(m, n);
}

double V(const BandMatrix& first, const BandMatrix& below, int m, int n) {
  if (m == 0) {
    return P(first, below, 1, 1, n) + P(first, below, -1, -1, n);
  }
  if (std::abs(m) == 1) {
    return std::sqrt(2.0) * P(first, below, m, 0, n);
  }
  return m > 0 ? P(first, below, 1, m - 1, n) - P(first, below, -1, 1 - m, n)
               : P(first, below, 1, m + 1, n) + P(first, below, -1, -m - 1, n);
}

double W(const BandMatrix& first, const BandMatrix& below, int m, int n) {
  return m > 0 ? P(first, below, 1, m + 1, n) + P(first, below, -1, -m - 1, n)
               : P(first, below, 1, m - 1, n) - P(first, below, -1, 1 - m, n);
}

// u, v, w of Ivanic & Ruedenberg, table 1, for an entry of a band's matrix, including the signs of
// their Kronecker deltas.
struct Weights {
  double u = 0.0, v = 0.0, w = 0.0;
};

Weights WeightsOf(int l, int m, int n) {
  const int a = std::abs(m);
  const double scale = std::abs(n) < l ? (l + n) * (l - n) : 2 * l * (2 * l - 1);
  const double v = 0.5 * std::sqrt((l + a - 1) * (l + a) / scale);
  return {std::sqrt((l + m) * (l - m) / scale), m == 0 ? -std::sqrt(2.0) * v : v,
          m == 0 ? 0.0 : -0.5 * std::sqrt((l - a - 1) * (l - a) / scale)};
}

// Index of the first entry of a band among all bands: 0, 1, 10, 35, 84, 165.
size_t BandBegin(int degree) {
  return static_cast<size_t>(degree * (2 * degree - 1) * (2 * degree + 1) / 3);
}

// Weights of all entries of all bands, precomputed because square roots are slow.
const std::array<Weights, 286>& AllWeights() {
  static const std::array<Weights, 286> all = [] {
    std::array<Weights, 286> weights;
    size_t i = BandBegin(2);
    for (int l = 2; l <= kShDegree; ++l) {
      for (int m = -l; m <= l; ++m) {
        for (int n = -l; n <= l; ++n) {
          weights[i++] = WeightsOf(l, m, n);
        }
      }
    }
    return weights;
  }();
  return all;
}

// A term whose weight is zero would reach outside the band below and is skipped.
BandMatrix NextBand(const BandMatrix& first, const BandMatrix& below) {
  const int l = below.degree() + 1;
  const Weights* weights = AllWeights().data() + BandBegin(l);
  BandMatrix band(l);
  for (int m = -l; m <= l; ++m) {
    for (int n = -l; n <= l; ++n, ++weights) {
      double sum = weights->v * V(first, below, m, n);
      if (std::abs(m) < l) {
        sum += weights->u * P(first, below, 0, m, n);
      }
      if (m != 0 && std::abs(m) < l - 1) {
        sum += weights->w * W(first, below, m, n);
      }
      band(m, n) = sum;
    }
  }
  return band;
}

}  // namespace

const std::array<double, kShCount>& ShNormalisation() {
  static const std::array<double, kShCount> factors = MakeNormalisation();
  return factors;
}

const std::array<float, kShCount>& FloatShNormalisation() {
  static const std::array<float, kShCount> factors = [] {
    std::array<float, kShCount> rounded;
    std::copy(ShNormalisation().begin(), ShNormalisation().end(), rounded.begin());
    return rounded;
  }();
  return factors;
}

std::array<float, kShCount> EvaluateShBasis(const glm::vec3& d) {
  std::array<float, kShCount> basis;
  EvaluateShBasis<kShCount>(d.x, d.y, d.z, FloatShNormalisation().data(), basis.data());
  return basis;
}

void EvaluateShBasis(const glm::vec3& direction, std::span<float> basis) {
  CHECK(basis.size() <= kShCount && IsShCount(static_cast<int>(basis.size())));
  const std::array<float, kShCount> all = EvaluateShBasis(direction);
  std::copy_n(all.begin(), basis.size(), basis.begin());
}

glm::vec3 EvaluateRadiance(const ShRgb& radiance, const glm::vec3& direction) {
  const std::array<float, kShCount> basis = EvaluateShBasis(direction);
  glm::vec3 sum(0.0f);
  for (size_t k = 0; k < kShCount; ++k) {
    sum += basis[k] * radiance[k];
  }
  return sum;
}

float ClampedCosineFactor(int degree) {
  constexpr std::array<double, kShDegree + 1> kFactors = {kPi, 2.0 * kPi / 3.0, kPi / 4.0,
                                                          0.0, -kPi / 24.0,     0.0};
  return static_cast<float>(kFactors[static_cast<size_t>(degree)]);
}

ShRgb ConvolveWithCosine(const ShRgb& radiance) {
  ShRgb irradiance;
  for (int k = 0; k < kShCount; ++k) {
    const auto i = static_cast<size_t>(k);
    irradiance[i] = ClampedCosineFactor(ShBandOf(k)) * radiance[i];
  }
  return irradiance;
}

glm::vec3 EvaluateIrradiance(const ShRgb& radiance, const glm::vec3& normal) {
  return glm::max(EvaluateRadiance(ConvolveWithCosine(radiance), normal), glm::vec3(0.0f));
}

ShRotation::ShRotation(const glm::quat& rotation, int degree)
    : ShRotation(glm::mat3_cast(rotation), degree) {}

ShRotation::ShRotation(const glm::mat3& rotation, int degree) : degree_(degree) {
  CHECK(degree >= 0 && degree <= kShDegree);
  const BandMatrix first = FirstBand(rotation);
  BandMatrix band = first;
  bands_[0] = 1.0f;
  for (int l = 1; l <= degree; ++l) {
    if (l > 1) {
      band = NextBand(first, band);
    }
    float* to = bands_.data() + BandBegin(l);
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) {
        *to++ = static_cast<float>(band(m, n));
      }
    }
  }
}

std::span<const float> ShRotation::band(int degree) const {
  CHECK(degree >= 0 && degree <= degree_);
  const auto side = static_cast<size_t>(2 * degree + 1);
  return std::span(bands_).subspan(BandBegin(degree), side * side);
}

void ShRotation::Apply(std::span<const float> coefficients, std::span<float> turned) const {
  DCHECK(coefficients.size() == turned.size() && IsShCount(static_cast<int>(turned.size())));
  size_t begin = 0;
  for (int l = 0; begin < coefficients.size(); ++l) {
    const auto side = static_cast<size_t>(2 * l + 1);
    const float* row = band(l).data();
    for (size_t m = 0; m < side; ++m, row += side) {
      float sum = 0.0f;
      for (size_t n = 0; n < side; ++n) {
        sum += row[n] * coefficients[begin + n];
      }
      turned[begin + m] = sum;
    }
    begin += side;
  }
}

ShRgb RotateSh(const ShRgb& radiance, const glm::quat& rotation) {
  const ShRotation turn(rotation);
  ShRgb rotated;
  for (int channel = 0; channel < 3; ++channel) {
    std::array<float, kShCount> coefficients, turned;
    for (size_t k = 0; k < kShCount; ++k) {
      coefficients[k] = radiance[k][channel];
    }
    turn.Apply(coefficients, turned);
    for (size_t k = 0; k < kShCount; ++k) {
      rotated[k][channel] = turned[k];
    }
  }
  return rotated;
}

ShRgb ProjectEquirectangular(std::span<const glm::vec3> pixels, int width, int height) {
  CHECK(width > 0 && height > 0 && pixels.size() == static_cast<size_t>(width) * height);
  std::array<glm::dvec3, kShCount> sums{};
  for (int row = 0; row < height; ++row) {
    const double elevation = kPi * (0.5 - (row + 0.5) / height);
    // The exact solid angle of a pixel between two circles of latitude.
    const double half_step = 0.5 * kPi / height;
    const double solid_angle =
        2.0 * kPi / width * (std::sin(elevation + half_step) - std::sin(elevation - half_step));
    for (int column = 0; column < width; ++column) {
      const double azimuth = 2.0 * kPi * ((column + 0.5) / width - 0.5);
      const glm::vec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                -std::cos(elevation) * std::cos(azimuth));
      const std::array<float, kShCount> basis = EvaluateShBasis(direction);
      const glm::dvec3 weighted =
          solid_angle * glm::dvec3(pixels[static_cast<size_t>(row) * width + column]);
      for (size_t k = 0; k < kShCount; ++k) {
        sums[k] += static_cast<double>(basis[k]) * weighted;
      }
    }
  }
  ShRgb radiance;
  for (size_t k = 0; k < kShCount; ++k) {
    radiance[k] = glm::vec3(sums[k]);
  }
  return radiance;
}

}  // namespace lararium::light
