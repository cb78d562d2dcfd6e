#pragma once

// Quadrature on the interval and the sphere.

#include <glm/vec3.hpp>
#include <vector>

namespace lararium::light {

struct QuadratureNode {
  double at = 0.0;
  double weight = 0.0;
};

// Gauss and Legendre's nodes on [low, high]: exact for polynomials of degree 2 count - 1.
std::vector<QuadratureNode> GaussLegendre(int count, double low, double high);

struct SphereNode {
  glm::dvec3 direction;
  double weight = 0.0;  // solid angle
};

// Nodes with low <= z <= high, exact for polynomials in x, y, z of this degree.
std::vector<SphereNode> SphereQuadrature(int degree, double low = -1.0, double high = 1.0);

}  // namespace lararium::light
