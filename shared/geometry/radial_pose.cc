#include "shared/geometry/radial_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace lararium::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector8d = Eigen::Matrix<double, 8, 1>;

// The real roots of a quartic, highest coefficient first: all four complex ones by the method of
// Durand and Kerner, of which those with a small imaginary part are polished by Newton's method.
int RealRoots(const std::array<double, 5>& quartic, std::array<double, 4>& roots) {
  using Complex = std::complex<double>;
  const double head = quartic[0];
  double largest = 0.0;
  for (const double c : quartic) {
    largest = std::max(largest, std::abs(c));
  }
  if (!(std::abs(head) > 1e-12 * largest)) {
    return 0;
  }
  const auto value = [&](auto x) {
    auto sum = x * head + quartic[1];
    for (size_t i = 2; i < quartic.size(); ++i) {
      sum = sum * x + quartic[i];
    }
    return sum;
  };
  // All roots lie within this radius (Fujiwara's bound).
  double radius = 0.0;
  for (int i = 1; i <= 4; ++i) {
    radius = std::max(radius, std::pow(std::abs(quartic[i] / head), 1.0 / i));
  }
  std::array<Complex, 4> z;
  for (int i = 0; i < 4; ++i) {
    z[i] = std::polar(radius, 0.4 + 0.5 * std::numbers::pi * i);
  }
  for (int iteration = 0; iteration < 60; ++iteration) {
    double moved = 0.0;
    for (int i = 0; i < 4; ++i) {
      Complex product = head;
      for (int j = 0; j < 4; ++j) {
        product *= j == i ? Complex(1.0) : z[i] - z[j];
      }
      const Complex step = value(z[i]) / product;
      if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) {
        return 0;
      }
      z[i] -= step;
      moved = std::max(moved, std::abs(step));
    }
    if (moved < 1e-10 * radius) {
      break;
    }
  }
  int count = 0;
  for (const Complex& root : z) {
    if (std::abs(root.imag()) > 1e-5 * std::max(std::abs(root), 1e-3 * radius)) {
      continue;
    }
    double x = root.real();
    for (int i = 0; i < 2; ++i) {
      const double slope =
          ((4.0 * head * x + 3.0 * quartic[1]) * x + 2.0 * quartic[2]) * x + quartic[3];
      const double step = value(x) / slope;
      x -= std::isfinite(step) && std::abs(step) < 1e-3 * radius ? step : 0.0;
    }
    roots[count++] = x;
  }
  return count;
}

// A polynomial of degree 2, and the product of two.
using Quadratic = std::array<double, 3>;  // Lowest coefficient first.

std::array<double, 5> Product(const Quadratic& a, const Quadratic& b) {
  std::array<double, 5> product{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      product[i + j] += a[i] * b[j];
    }
  }
  return product;
}

// The quadratic forms of the first two rows of a pose, each as (r1, t1, r2, t2): their dot product
// and the difference of their squared norms.
double Dot(const Vector8d& a, const Vector8d& b) {
  return 0.5 * (a.head<3>().dot(b.segment<3>(4)) + b.head<3>().dot(a.segment<3>(4)));
}
double Difference(const Vector8d& a, const Vector8d& b) {
  return a.head<3>().dot(b.head<3>()) - a.segment<3>(4).dot(b.segment<3>(4));
}

// The vectors of a null space (up to scale) whose rows are orthogonal and equally long.
int OrthogonalRows(const Eigen::Matrix<double, 8, 3>& space, std::array<Vector8d, 4>& found) {
  // a n0 + b n1 + n2: one quadratic in a for each form, with coefficients that depend on b.
  const Vector8d n0 = space.col(0);
  const Vector8d n1 = space.col(1);
  const Vector8d n2 = space.col(2);
  struct Form {
    double square = 0.0;  // a^2
    Quadratic linear{};   // a
    Quadratic constant{};
  };
  const auto form = [&](auto of) {
    return Form{of(n0, n0),
                {2.0 * of(n0, n2), 2.0 * of(n0, n1), 0.0},
                {of(n2, n2), 2.0 * of(n1, n2), of(n1, n1)}};
  };
  const Form f = form(Dot);
  const Form g = form(Difference);
  // Eliminating a^2 leaves a = -rest / slope.
  Quadratic slope{};
  Quadratic rest{};
  for (size_t i = 0; i < 3; ++i) {
    slope[i] = g.square * f.linear[i] - f.square * g.linear[i];
    rest[i] = g.square * f.constant[i] - f.square * g.constant[i];
  }
  const Form& larger = std::abs(f.square) > std::abs(g.square) ? f : g;
  // square rest^2 - linear rest slope + constant slope^2, of degree 4: slope and linear have
  // degree 1.
  const std::array<double, 5> rest2 = Product(rest, rest);
  const std::array<double, 5> slope2 = Product(slope, slope);
  const std::array<double, 5> mixed = Product(slope, larger.linear);
  const std::array<double, 5> first = Product({mixed[0], mixed[1], mixed[2]}, rest);
  const std::array<double, 5> second = Product({slope2[0], slope2[1], slope2[2]}, larger.constant);
  std::array<double, 5> quartic{};
  for (size_t i = 0; i < 5; ++i) {
    quartic[4 - i] = larger.square * rest2[i] - first[i] + second[i];
  }
  std::array<double, 4> roots{};
  const int count = RealRoots(quartic, roots);
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const double b = roots[i];
    const double divisor = slope[0] + b * slope[1];
    const double a = -(rest[0] + b * (rest[1] + b * rest[2])) / divisor;
    if (std::isfinite(a)) {
      found[kept++] = a * n0 + b * n1 + n2;
    }
  }
  return kept;
}

// The rest of a pose whose first two rows are known, by the distances from the principal point.
// Returns whether all points are in front of the camera.
bool Complete(const std::array<Eigen::Vector2d, 5>& pixels,
              const std::array<Vector3d, 5>& points,
              const Vector8d& rows,
              double half_size,
              RadialPose& solution) {
  const double scale =
      std::sqrt(0.5 * (rows.head<3>().squaredNorm() + rows.segment<3>(4).squaredNorm()));
  if (!(scale > 0.0)) {
    return false;
  }
  Vector8d unit = rows / scale;
  double along = 0.0;
  for (size_t i = 0; i < 5; ++i) {
    const Vector3d& x = points[i];
    const Eigen::Vector2d seen(unit.head<3>().dot(x) + unit[3],
                               unit.segment<3>(4).dot(x) + unit[7]);
    along += pixels[i].dot(seen) > 0.0 ? 1.0 : -1.0;
  }
  if (std::abs(along) < 5.0) {
    return false;  // A pixel lies on the other side of the principal point.
  }
  unit *= along > 0.0 ? 1.0 : -1.0;
  Matrix3d rotation;
  rotation.row(0) = unit.head<3>().normalized();
  rotation.row(1) = unit.segment<3>(4).normalized();
  rotation.row(2) = rotation.row(0).cross(rotation.row(1));
  // R f + R r^2 (f division) - r t = r w, where R is the distance from the axis, w the depth
  // without t, and r the pixel's distance in units of half_size.
  constexpr double kNoise = 2e-3;       // Relative noise of the distances.
  constexpr double kDistortion = 0.15;  // Deviation of the division at the distance half_size.
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  double depth_scale = 0.0;
  for (size_t i = 0; i < 5; ++i) {
    const Vector3d turned = rotation * points[i];
    const double r = pixels[i].norm() / half_size;
    const double axis = std::hypot(turned.x() + unit[3], turned.y() + unit[7]);
    const Vector3d row(axis, axis * r * r, -r);
    normal.noalias() += row * row.transpose();
    right += row * (r * turned.z());
    depth_scale += axis * axis;
  }
  normal(1, 1) += depth_scale * std::pow(kNoise / kDistortion, 2);
  const Vector3d unknowns = normal.ldlt().solve(right);
  const double focal = unknowns[0];
  if (!unknowns.allFinite() || !(focal > 0.1) || !(focal < 20.0)) {
    return false;
  }
  solution.focal = focal * half_size;
  solution.division = unknowns[1] / focal / (half_size * half_size);
  const Vector3d translation(unit[3], unit[7], unknowns[2]);
  for (const Vector3d& point : points) {
    if (!(rotation.row(2).dot(point) + translation.z() > 0.0)) {
      return false;
    }
  }
  solution.camera_from_world = Rigid3::FromMatrix(rotation, translation);
  return solution.camera_from_world.rotation.coeffs().allFinite();
}

}  // namespace

RadialPoseSolutions SolveRadialPose(const std::array<Eigen::Vector2d, 5>& pixels,
                                    const std::array<Vector3d, 5>& points,
                                    double half_size) {
  RadialPoseSolutions solutions;
  // A point at (x, y) along the axes is seen in the direction of its pixel: v x - u y = 0. The
  // points are centred and scaled, so that the equations are well conditioned.
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : points) {
    middle += 0.2 * point;
  }
  double size = 0.0;
  for (const Vector3d& point : points) {
    size = std::max(size, (point - middle).norm());
  }
  if (!(size > 0.0) || !std::isfinite(size)) {
    return solutions;
  }
  std::array<Vector3d, 5> centred;
  Eigen::Matrix<double, 8, 5> equations;
  for (int i = 0; i < 5; ++i) {
    centred[i] = (points[i] - middle) / size;
    const double length = pixels[i].norm();
    if (!(length > 1e-6 * half_size)) {
      return solutions;  // The principal point has no direction.
    }
    const Eigen::Vector2d direction = pixels[i] / length;
    equations.col(i) << direction.y() * centred[i], direction.y(), -direction.x() * centred[i],
        -direction.x();
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 8, 5>> qr(equations);
  const Eigen::Matrix<double, 8, 8> q = qr.householderQ();
  std::array<Vector8d, 4> rows;
  const int count = OrthogonalRows(q.rightCols<3>(), rows);
  for (int i = 0; i < count; ++i) {
    RadialPose& solution = solutions.solutions[solutions.count];
    if (Complete(pixels, centred, rows[i], half_size, solution)) {
      Rigid3& pose = solution.camera_from_world;
      pose.translation = size * pose.translation - pose.rotation * middle;
      ++solutions.count;
    }
  }
  return solutions;
}

}  // namespace lararium::geometry
