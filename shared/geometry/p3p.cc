#include "shared/geometry/p3p.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace lararium::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The depth vector d along the rays satisfies d' (quadric[i]) d = squared_length[i]. Side i of the
// triangle is opposite to point i.
struct Triangle {
  std::array<Matrix3d, 3> quadric;
  Vector3d squared_length;
};

Triangle TriangleOf(const std::array<Vector3d, 3>& rays, const std::array<Vector3d, 3>& points) {
  Triangle triangle;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    Matrix3d& q = triangle.quadric[i];
    q.setZero();
    q(j, j) = q(k, k) = 1.0;
    q(j, k) = q(k, j) = -rays[j].dot(rays[k]);
    triangle.squared_length[i] = (points[j] - points[k]).squaredNorm();
  }
  return triangle;
}

// Returns a real root of x^3 + b x^2 + c x + d. If there are several, the one of steepest slope: it
// is outside the two stationary points, where Newton's method converges from any start.
double CubicRoot(double b, double c, double d) {
  const auto value = [&](double x) { return ((x + b) * x + c) * x + d; };
  double x = -b / 3.0;
  const double discriminant = b * b - 3.0 * c;
  if (discriminant > 0.0) {
    const double root = std::sqrt(discriminant);
    const double maximum = (-b - root) / 3.0;
    const double minimum = (-b + root) / 3.0;
    // The parabola through the stationary point; its curvature is 2 root.
    x = value(maximum) > 0.0 ? maximum - std::sqrt(value(maximum) / root)
                             : minimum + std::sqrt(std::max(-value(minimum), 0.0) / root);
  }
  for (int i = 0; i < 50; ++i) {
    const double slope = (3.0 * x + 2.0 * b) * x + c;
    if (slope == 0.0) {
      break;
    }
    const double step = value(x) / slope;
    x -= step;
    if (std::abs(step) <= 1e-15 * std::abs(x)) {
      break;
    }
  }
  return x;
}

Matrix3d Adjugate(const Matrix3d& m) {
  Matrix3d adjugate;
  adjugate.row(0) = m.col(1).cross(m.col(2)).transpose();
  adjugate.row(1) = m.col(2).cross(m.col(0)).transpose();
  adjugate.row(2) = m.col(0).cross(m.col(1)).transpose();
  return adjugate;
}

// Returns a degenerate member of the pencil of a and b, and another member.
std::optional<std::pair<Matrix3d, Matrix3d>> DegenerateConic(Matrix3d a, Matrix3d b) {
  double c0 = a.determinant();
  double c3 = b.determinant();
  if (std::abs(c0) > std::abs(c3)) {
    std::swap(a, b);
    std::swap(c0, c3);
  }
  if (c0 == 0.0) {
    return std::pair(a, b);
  }
  // det(a + x b) / det b
  const double x =
      CubicRoot((Adjugate(b) * a).trace() / c3, (Adjugate(a) * b).trace() / c3, c0 / c3);
  if (!std::isfinite(x)) {
    return std::nullopt;
  }
  return std::pair<Matrix3d, Matrix3d>(a + x * b, std::abs(x) < 1.0 ? b : a);
}

// Finds the real ratios (x : y) with a x^2 + 2 b x y + c y^2 = 0. A slightly negative discriminant
// counts as a double root with rounding errors.
int QuadraticRatios(double a, double b, double c, std::array<std::pair<double, double>, 2>& out) {
  const double scale = std::max({std::abs(a), std::abs(b), std::abs(c)});
  double discriminant = b * b - a * c;
  if (scale == 0.0 || discriminant < -1e-12 * scale * scale) {
    return 0;
  }
  discriminant = std::max(discriminant, 0.0);
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  out[0] = {q, a};
  out[1] = {c, q};
  return 2;
}

// Refines the depths by Newton's method on the three quadrics.
bool PolishDepths(const Triangle& triangle, Vector3d& depths) {
  for (int iteration = 0; iteration < 5; ++iteration) {
    Matrix3d jacobian;
    Vector3d residual;
    for (int i = 0; i < 3; ++i) {
      const Vector3d product = triangle.quadric[i] * depths;
      residual[i] = depths.dot(product) - triangle.squared_length[i];
      jacobian.row(i) = 2.0 * product.transpose();
    }
    if (residual.cwiseAbs().maxCoeff() < 1e-15) {
      break;
    }
    const Vector3d step = jacobian.inverse() * residual;
    // At a double root the Jacobian is singular; the present depths are good enough.
    if (!(step.norm() < 0.1 * depths.norm())) {
      break;
    }
    depths -= step;
  }
  for (int i = 0; i < 3; ++i) {
    const double residual = depths.dot(triangle.quadric[i] * depths) - triangle.squared_length[i];
    if (!(std::abs(residual) < 1e-6)) {
      return false;
    }
  }
  return depths.minCoeff() > 0.0;
}

Matrix3d OrthonormalFrame(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Matrix3d frame;
  frame.col(0) = (b - a).normalized();
  frame.col(2) = (b - a).cross(c - a).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

void AddPose(const std::array<Vector3d, 3>& rays,
             const std::array<Vector3d, 3>& points,
             const Vector3d& depths,
             P3pSolutions& solutions) {
  const Vector3d a = depths[0] * rays[0];
  const Vector3d b = depths[1] * rays[1];
  const Vector3d c = depths[2] * rays[2];
  const Matrix3d rotation =
      OrthonormalFrame(a, b, c) * OrthonormalFrame(points[0], points[1], points[2]).transpose();
  const Vector3d translation = (a + b + c - rotation * (points[0] + points[1] + points[2])) / 3.0;
  const Rigid3 pose = Rigid3::FromMatrix(rotation, translation);
  if (pose.rotation.coeffs().allFinite() && translation.allFinite()) {
    solutions.camera_from_world[solutions.count++] = pose;
  }
}

bool IsDegenerate(const std::array<Vector3d, 3>& rays, const std::array<Vector3d, 3>& points) {
  const Vector3d u = points[1] - points[0];
  const Vector3d v = points[2] - points[0];
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
  double least_angle = 1.0;
  for (int i = 0; i < 3; ++i) {
    least_angle = std::min(least_angle, rays[i].cross(rays[(i + 1) % 3]).squaredNorm());
  }
  return !(u.cross(v).norm() > 1e-7 * longest) || !(least_angle > 1e-14);
}

}  // namespace

P3pSolutions SolveP3p(const std::array<Vector3d, 3>& rays, const std::array<Vector3d, 3>& points) {
  P3pSolutions solutions;
  if (IsDegenerate(rays, points)) {
    return solutions;
  }
  Triangle triangle = TriangleOf(rays, points);
  const double longest = triangle.squared_length.maxCoeff();
  triangle.squared_length /= longest;
  const Vector3d& a = triangle.squared_length;
  const auto& q = triangle.quadric;

  const auto conic = DegenerateConic(q[2] * a[0] - q[0] * a[2], q[1] * a[0] - q[0] * a[1]);
  if (!conic) {
    return solutions;
  }
  const auto& [planes, other] = *conic;

  // d' planes d = 0 as a quadratic for the depth i with the largest square:
  // d_i = w_j d_j + w_k d_k, twice.
  int i = 0;
  planes.diagonal().cwiseAbs().maxCoeff(&i);
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  const double head = planes(i, i);
  if (head == 0.0) {
    return solutions;
  }
  const double pp = planes(i, j) * planes(i, j) - head * planes(j, j);
  const double qq = planes(i, k) * planes(i, k) - head * planes(k, k);
  const double pq = planes(i, j) * planes(i, k) - head * planes(j, k);
  const double larger = std::sqrt(std::max({pp, qq, 0.0}));
  const double smaller = larger > 0.0 ? pq / larger : 0.0;
  const double root_j = pp >= qq ? larger : smaller;
  const double root_k = pp >= qq ? smaller : larger;

  const Matrix3d sum = q[0] + q[1] + q[2];
  for (const double sign : {1.0, -1.0}) {
    // The plane's depths: x * along_j + y * along_k.
    Vector3d along_j = Vector3d::Unit(j);
    Vector3d along_k = Vector3d::Unit(k);
    along_j[i] = (-planes(i, j) + sign * root_j) / head;
    along_k[i] = (-planes(i, k) + sign * root_k) / head;
    std::array<std::pair<double, double>, 2> ratios;
    const int count = QuadraticRatios(along_j.dot(other * along_j), along_j.dot(other * along_k),
                                      along_k.dot(other * along_k), ratios);
    for (int r = 0; r < count; ++r) {
      Vector3d depths = ratios[r].first * along_j + ratios[r].second * along_k;
      depths *= depths.sum() < 0.0 ? -1.0 : 1.0;
      const double squared = depths.dot(sum * depths);
      if (!(squared > 0.0) || !(depths.minCoeff() > 0.0)) {
        continue;
      }
      depths *= std::sqrt(a.sum() / squared);
      if (PolishDepths(triangle, depths)) {
        AddPose(rays, points, depths * std::sqrt(longest), solutions);
      }
    }
    if (larger == 0.0) {
      break;  // The two planes coincide.
    }
  }
  return solutions;
}

}  // namespace lararium::geometry
