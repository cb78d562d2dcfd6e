#pragma once

// Real spherical harmonics up to degree 5 (36 coefficients), index l(l+1)+m, polar
// axis Z, in stage axes (Y up), without the Condon-Shortley phase: degree 1 is y, z, x.
// Ramamoorthi & Hanrahan, "An Efficient Representation for Irradiance Environment
// Maps", SIGGRAPH 2001; Sloan, "Stupid Spherical Harmonics (SH) Tricks", GDC 2008.

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace lararium::light {

inline constexpr int kShDegree = 5;
inline constexpr int kShCount = (kShDegree + 1) * (kShDegree + 1);
// Number of coefficients for unshadowed light: degree 2.
inline constexpr int kPlainShCount = 9;
// One RGB coefficient for each basis function: linear radiance.
using ShRgb = std::array<glm::vec3, kShCount>;

// True for counts that fill whole bands: 1, 4, 9, 16, 25, 36.
constexpr bool IsShCount(int count) {
  return count == 1 || count == 4 || count == 9 || count == 16 || count == 25 || count == 36;
}
// Returns the highest degree of a count.
constexpr int ShDegreeOf(int count) {
  int degree = 0;
  while ((degree + 1) * (degree + 1) < count) {
    ++degree;
  }
  return degree;
}
// Returns the degree of the basis function with this index.
constexpr int ShBandOf(int index) { return ShDegreeOf(index + 1); }

// The factors that make the basis orthonormal, with the index above: sqrt((2l+1)/(4 pi)
// (l-|m|)!/(l+|m|)!), times sqrt(2) unless m = 0.
const std::array<double, kShCount>& ShNormalisation();
const std::array<float, kShCount>& FloatShNormalisation();

// Evaluates the first Count basis functions at a unit direction for any number type: float, double
// or a register of floats. Uses the recurrence of the associated Legendre functions without their
// factor sin^m, which x and y contain.
template <int Count, typename Number, typename Scalar>
inline void EvaluateShBasis(
    const Number& x, const Number& y, const Number& z, const Scalar* normalisation, Number* basis) {
  static_assert(IsShCount(Count));
  constexpr int kDegree = ShDegreeOf(Count);
  Number cosine = x * Scalar(0) + Scalar(1);  // sin^m(polar) cos(m azimuth)
  Number sine = x * Scalar(0);
  Scalar diagonal(1);  // P(m, m) = (2m - 1)!!
#pragma GCC unroll 6
  for (int m = 0; m <= kDegree; ++m) {
    Number before = x * Scalar(0);
    Number legendre = x * Scalar(0) + diagonal;
#pragma GCC unroll 6
    for (int l = m; l <= kDegree; ++l) {
      const int zero = l * (l + 1);
      basis[zero + m] = legendre * cosine * normalisation[zero + m];
      if (m > 0) {
        basis[zero - m] = legendre * sine * normalisation[zero - m];
      }
      const Number next = (z * legendre * Scalar(2 * l + 1) - before * Scalar(l + m)) *
                          (Scalar(1) / Scalar(l + 1 - m));
      before = legendre;
      legendre = next;
    }
    diagonal *= Scalar(2 * m + 1);
    const Number turned = x * cosine - y * sine;
    sine = x * sine + y * cosine;
    cosine = turned;
  }
}

// Evaluates all basis functions at a unit direction. The second overload fills the span, whose size
// must be a count of full bands.
std::array<float, kShCount> EvaluateShBasis(const glm::vec3& direction);
void EvaluateShBasis(const glm::vec3& direction, std::span<float> basis);

// Returns the radiance from a direction.
glm::vec3 EvaluateRadiance(const ShRgb& radiance, const glm::vec3& direction);

// Factor of the clamped cosine for a band: pi, 2 pi / 3, pi / 4, 0, -pi / 24, 0 (Ramamoorthi &
// Hanrahan 2001, equations 7 and 8).
float ClampedCosineFactor(int degree);

// Converts radiance to irradiance: its value at a direction is that of a surface with this normal.
ShRgb ConvolveWithCosine(const ShRgb& radiance);

// Irradiance on a surface with a unit normal, never negative.
glm::vec3 EvaluateIrradiance(const ShRgb& radiance, const glm::vec3& normal);

// Matrices that rotate coefficients as the rotation rotates the function, one for each band, by the
// recurrence of Ivanic & Ruedenberg, J. Phys. Chem. 100 (1996), with the corrections in 102 (1998).
class ShRotation {
 public:
  // degree: the highest degree that is needed; a lower one is faster.
  explicit ShRotation(const glm::quat& rotation, int degree = kShDegree);
  explicit ShRotation(const glm::mat3& rotation, int degree = kShDegree);

  // Matrix of a degree: (2l+1) x (2l+1), row-major, rows and columns by m + l.
  std::span<const float> band(int degree) const;
  // turned = f(rotation^-1 d). Both hold the same count of full bands and do not overlap.
  void Apply(std::span<const float> coefficients, std::span<float> turned) const;

 private:
  static constexpr size_t kFloats = 1 + 9 + 25 + 49 + 81 + 121;
  int degree_;
  std::array<float, kFloats> bands_;
};

// Rotates the light: coefficients of f(rotation^-1 d).
ShRgb RotateSh(const ShRgb& radiance, const glm::quat& rotation);

// Projects an equirectangular image of radiance, solid-angle weighted. Pixel
// (column, row) is the direction of azimuth 2 pi ((column + 0.5) / width - 0.5)
// from -Z towards +X and elevation pi (0.5 - (row + 0.5) / height): the image
// centre looks along -Z, the top row is the zenith (docs/file-formats.md).
ShRgb ProjectEquirectangular(std::span<const glm::vec3> pixels, int width, int height);

}  // namespace lararium::light
