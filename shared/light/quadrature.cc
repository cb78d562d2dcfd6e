#include "shared/light/quadrature.h"

#include <algorithm>
#include <cmath>

#include "shared/core/units.h"

namespace lararium::light {
namespace {

struct Legendre {
  double value = 0.0;
  double derivative = 0.0;
};

Legendre EvaluateLegendre(int degree, double x) {
  double before = 1.0, value = x;
  for (int l = 2; l <= degree; ++l) {
    const double next = ((2 * l - 1) * x * value - (l - 1) * before) / l;
    before = value;
    value = next;
  }
  return {value, degree * (x * value - before) / (x * x - 1.0)};
}

}  // namespace

std::vector<QuadratureNode> GaussLegendre(int count, double low, double high) {
  std::vector<QuadratureNode> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (count + 0.5));  // Tricomi's approximation
    Legendre p;
    for (int newton = 0; newton < 8; ++newton) {
      p = EvaluateLegendre(count, x);
      x -= p.value / p.derivative;
    }
    p = EvaluateLegendre(count, x);
    const double weight = 2.0 / ((1.0 - x * x) * p.derivative * p.derivative);
    nodes.push_back({0.5 * (low + high) + 0.5 * (high - low) * x, 0.5 * (high - low) * weight});
  }
  return nodes;
}

std::vector<SphereNode> SphereQuadrature(int degree, double low, double high) {
  const int azimuths = degree + 1;
  std::vector<SphereNode> nodes;
  for (const QuadratureNode& z : GaussLegendre(std::max(2, degree / 2 + 1), low, high)) {
    const double radius = std::sqrt(1.0 - z.at * z.at);
    for (int i = 0; i < azimuths; ++i) {
      const double azimuth = 2.0 * kPi * (i + 0.5) / azimuths;
      nodes.push_back({{radius * std::cos(azimuth), radius * std::sin(azimuth), z.at},
                       2.0 * kPi / azimuths * z.weight});
    }
  }
  return nodes;
}

}  // namespace lararium::light
