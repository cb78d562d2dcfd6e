#include "player/benchmark/benchmark_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "shared/core/median.h"
#include "shared/core/random.h"
#include "shared/core/statistics.h"
#include "shared/geometry/point_spread.h"
#include "shared/geometry/transform.h"

namespace lararium::player {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::CameraModel;
using geometry::Rigid3;
using geometry::Similarity3;
using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

constexpr size_t kTriples = 1000;       // number of triples in the robust fit
constexpr double kFlat = 1e-2;          // second spread / first: below this, centres are on a line
constexpr double kFlatTriple = 1e-3;    // the same ratio for three centres
constexpr double kInlierMedians = 5.0;  // residual / median; removes only gross errors
constexpr int kInlierRounds = 20;
constexpr size_t kSampledPoints = 1000;
constexpr int kIterations = 50;
constexpr double kLeastStep = 1e-10;
constexpr double kMostDamping = 1e6;

// ------------------------------------------------------------ centres

// Whether points lie nearly on a line: they spread across it by at most `bound` of their spread
// along it.
bool Flat(std::span<const Vector3d> points, double bound) {
  const Vector3d deviations = geometry::SpreadOf(points).deviations;
  return !(deviations[1] > bound * deviations[2]);
}

struct Centres {
  std::vector<Vector3d> map;
  std::vector<Vector3d> world;
};

std::vector<double> Residuals(const Centres& centres, const Similarity3& world_from_map) {
  std::vector<double> residuals;
  for (size_t i = 0; i < centres.map.size(); ++i) {
    residuals.push_back((world_from_map * centres.map[i] - centres.world[i]).norm());
  }
  return residuals;
}

std::optional<Similarity3> Fit(const Centres& centres, std::span<const size_t> chosen) {
  std::vector<Vector3d> map;
  std::vector<Vector3d> world;
  for (const size_t i : chosen) {
    map.push_back(centres.map[i]);
    world.push_back(centres.world[i]);
  }
  if (Flat(map, kFlatTriple)) {
    return std::nullopt;
  }
  const Result<Similarity3> fit = geometry::EstimateSimilarity(world, map);
  return fit.ok() && fit->scale > 0.0 ? std::optional(*fit) : std::nullopt;
}

std::vector<std::array<size_t, 3>> Triples(size_t count) {
  std::vector<std::array<size_t, 3>> triples;
  if (count * (count - 1) * (count - 2) / 6 <= kTriples) {
    for (size_t a = 0; a < count; ++a) {
      for (size_t b = a + 1; b < count; ++b) {
        for (size_t c = b + 1; c < count; ++c) {
          triples.push_back({a, b, c});
        }
      }
    }
    return triples;
  }
  Random random(1);
  while (triples.size() < kTriples) {
    const auto draw = [&] { return size_t{random.Below(static_cast<uint32_t>(count))}; };
    const std::array<size_t, 3> triple = {draw(), draw(), draw()};
    if (triple[0] != triple[1] && triple[0] != triple[2] && triple[1] != triple[2]) {
      triples.push_back(triple);
    }
  }
  return triples;
}

// Computes the rotation from the orientations, scale and translation from the centres.
Similarity3 FromOrientations(std::span<const PosePair> pairs, const Centres& centres) {
  Matrix3d sum = Matrix3d::Zero();
  Vector3d mean_map = Vector3d::Zero();
  Vector3d mean_world = Vector3d::Zero();
  const auto count = static_cast<double>(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    sum += (pairs[i].camera_from_world.rotation.conjugate() * pairs[i].camera_from_map.rotation)
               .toRotationMatrix();
    mean_map += centres.map[i] / count;
    mean_world += centres.world[i] / count;
  }
  Similarity3 move;
  move.rotation = geometry::ClosestRotation(sum);
  double variance = 0.0;
  double true_variance = 0.0;
  double covariance = 0.0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Vector3d offset = centres.map[i] - mean_map;
    variance += offset.squaredNorm();
    true_variance += (centres.world[i] - mean_world).squaredNorm();
    covariance += (move.rotation * offset).dot(centres.world[i] - mean_world);
  }
  if (variance > 1e-18 && true_variance > 1e-18 && covariance > 0.0) {
    move.scale = covariance / variance;
  }
  move.translation = mean_world - move.scale * (move.rotation * mean_map);
  return move;
}

Similarity3 LeastMedianOfSquares(const Centres& centres) {
  Similarity3 best;
  double best_score = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::optional<Similarity3>& candidate) {
    if (candidate) {
      const double score = Median(Residuals(centres, *candidate));
      if (score < best_score) {
        best = *candidate;
        best_score = score;
      }
    }
  };
  std::vector<size_t> all(centres.map.size());
  for (size_t i = 0; i < all.size(); ++i) {
    all[i] = i;
  }
  consider(Fit(centres, all));
  for (const std::array<size_t, 3>& triple : Triples(centres.map.size())) {
    consider(Fit(centres, triple));
  }
  return best;
}

// ------------------------------------------------------------ points

// The least-squares problem of the refinement: projections of the points as a function of the
// alignment.
class PointFit {
 public:
  PointFit(std::span<const PosePair> pairs,
           const std::vector<bool>& inliers,
           std::span<const Vector3d> points) {
    const size_t step = std::max<size_t>(1, points.size() / kSampledPoints);
    std::vector<Vector3d> sample;
    for (size_t i = 0; i < points.size(); i += step) {
      sample.push_back(points[i]);
    }
    for (const Vector3d& p : sample) {
      origin_ += p / static_cast<double>(sample.size());
    }
    double size = 0.0;
    for (const Vector3d& p : sample) {
      size += (p - origin_).norm() / static_cast<double>(sample.size());
    }
    size_ = size > 0.0 ? size : 1.0;
    for (size_t i = 0; i < pairs.size(); ++i) {
      if (inliers[i]) {
        views_.push_back(
            {pairs[i], VisiblePoints(sample, pairs[i].camera, pairs[i].camera_from_world)});
      }
    }
  }

  size_t count() const {
    size_t count = 0;
    for (const View& view : views_) {
      count += view.visible.size();
    }
    return count;
  }

  std::vector<double> Distances(const Similarity3& move) const {
    std::vector<double> distances;
    for (const View& view : views_) {
      const Rigid3 pose = CameraFromWorld(view.pair.camera_from_map, move);
      for (const VisiblePoint& point : view.visible) {
        distances.push_back(Difference(view.pair.camera, pose * point.in_world, point).norm());
      }
    }
    return distances;
  }

  static double Cost(std::span<const double> distances, double bound) {
    double cost = 0.0;
    for (const double d : distances) {
      cost += d < bound ? d * d : bound * (2.0 * d - bound);
    }
    return cost;
  }

  // Normal equations for (rotation about the points' mean, translation in units of their size,
  // change of scale).
  void Linearise(const Similarity3& move, double bound, Matrix7d& normal, Vector7d& right) const {
    normal.setZero();
    right.setZero();
    for (const View& view : views_) {
      const Rigid3 pose = CameraFromWorld(view.pair.camera_from_map, move);
      const Matrix3d rotation = pose.rotation.toRotationMatrix();
      const Vector3d grown = rotation * (pose.Center() - origin_);
      for (const VisiblePoint& point : view.visible) {
        const Vector3d in_camera = pose * point.in_world;
        const Vector2d residual = Difference(view.pair.camera, in_camera, point);
        Eigen::Matrix<double, 3, 7> move_point;
        move_point << rotation * geometry::Skew(point.in_world - origin_), -size_ * rotation,
            -grown;
        const Eigen::Matrix<double, 2, 7> jacobian =
            ProjectionJacobian(view.pair.camera, in_camera, point) * move_point;
        const double weight = std::min(1.0, bound / std::max(residual.norm(), 1e-300));
        normal.noalias() += weight * jacobian.transpose() * jacobian;
        right.noalias() -= weight * jacobian.transpose() * residual;
      }
    }
  }

  Similarity3 Stepped(const Similarity3& move, const Vector7d& step) const {
    const Eigen::Quaterniond turn = geometry::RotationFromVector(step.head<3>());
    const double grow = std::exp(step[6]);
    return {move.scale * grow, (turn * move.rotation).normalized(),
            grow * (turn * (move.translation - origin_)) + origin_ + size_ * step.segment<3>(3)};
  }

 private:
  struct View {
    PosePair pair;
    std::vector<VisiblePoint> visible;
  };

  // Each axis is limited to the diagonal of the image. A point behind the camera gets the diagonal.
  static Vector2d Difference(const CameraModel& camera,
                             const Vector3d& in_camera,
                             const VisiblePoint& point) {
    const double limit = std::hypot(camera.width, camera.height);
    const std::optional<Vector2d> pixel = camera.Project(in_camera);
    if (!pixel) {
      return Vector2d::Constant(limit);
    }
    return (*pixel - point.pixel).cwiseMax(-limit).cwiseMin(limit);
  }

  static Eigen::Matrix<double, 2, 3> ProjectionJacobian(const CameraModel& camera,
                                                        const Vector3d& in_camera,
                                                        const VisiblePoint& point) {
    const double step = 1e-6 * std::max(in_camera.norm(), 1e-12);
    Eigen::Matrix<double, 2, 3> jacobian;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d offset = step * Vector3d::Unit(axis);
      jacobian.col(axis) = (Difference(camera, in_camera + offset, point) -
                            Difference(camera, in_camera - offset, point)) /
                           (2.0 * step);
    }
    return jacobian;
  }

  std::vector<View> views_;
  Vector3d origin_ = Vector3d::Zero();  // centre of the rotation: mean of the points
  double size_ = 1.0;                   // mean distance of the points from origin_
};

Similarity3 Refine(const Similarity3& start, const PointFit& fit) {
  if (fit.count() < 10) {
    return start;
  }
  Similarity3 best = start;
  double damping = 1e-3;
  for (int i = 0; i < kIterations && damping <= kMostDamping; ++i) {
    const std::vector<double> distances = fit.Distances(best);
    const double bound = std::max(2.0 * Median(distances), 1e-9);
    Matrix7d normal;
    Vector7d right;
    fit.Linearise(best, bound, normal, right);
    normal.diagonal() *= 1.0 + damping;
    const Vector7d step = normal.completeOrthogonalDecomposition().solve(right);
    const Similarity3 trial = fit.Stepped(best, step);
    if (PointFit::Cost(fit.Distances(trial), bound) < PointFit::Cost(distances, bound)) {
      best = trial;
      damping /= 10.0;
      if (step.cwiseAbs().maxCoeff() < kLeastStep) {
        break;
      }
    } else {
      damping *= 10.0;
    }
  }
  return best;
}

}  // namespace

Rigid3 CameraFromWorld(const Rigid3& camera_from_map, const Similarity3& world_from_map) {
  return geometry::CameraFromB(camera_from_map, world_from_map.Inverse());
}

std::vector<VisiblePoint> VisiblePoints(std::span<const Vector3d> points,
                                        const CameraModel& camera,
                                        const Rigid3& camera_from_world) {
  const double margin = 0.25 * std::max(camera.width, camera.height);
  std::vector<VisiblePoint> visible;
  for (const Vector3d& point : points) {
    const Vector3d in_camera = camera_from_world * point;
    const std::optional<Vector2d> pixel = camera.Project(in_camera);
    if (!pixel || !camera.Contains(*pixel)) {
      continue;
    }
    // Skips points that the distortion model would fold back into the image, in the same way as the
    // evaluator of the data sets.
    const double x = camera.fx * in_camera.x() / in_camera.z() + camera.cx;
    const double y = camera.fy * in_camera.y() / in_camera.z() + camera.cy;
    if (x > -margin && y > -margin && x < camera.width + margin && y < camera.height + margin) {
      visible.push_back({point, *pixel});
    }
  }
  return visible;
}

std::vector<double> RegistrationErrors(std::span<const VisiblePoint> visible,
                                       const CameraModel& camera,
                                       const Rigid3& camera_from_world) {
  const double diagonal = std::hypot(camera.width, camera.height);
  std::vector<double> errors;
  errors.reserve(visible.size());
  for (const VisiblePoint& point : visible) {
    const std::optional<Vector2d> pixel = camera.Project(camera_from_world * point.in_world);
    errors.push_back(pixel ? std::min((*pixel - point.pixel).norm(), diagonal) : diagonal);
  }
  return errors;
}

std::optional<Alignment> AlignOnCentres(std::span<const PosePair> pairs) {
  if (pairs.empty()) {
    return std::nullopt;
  }
  Centres centres;
  for (const PosePair& pair : pairs) {
    centres.map.push_back(pair.camera_from_map.Center());
    centres.world.push_back(pair.camera_from_world.Center());
  }
  Alignment alignment{{}, std::vector<bool>(pairs.size(), true)};
  if (pairs.size() < 3 || Flat(centres.map, kFlat) || Flat(centres.world, kFlat)) {
    alignment.world_from_map = FromOrientations(pairs, centres);
    return alignment;
  }
  alignment.world_from_map = LeastMedianOfSquares(centres);
  for (int round = 0; round < kInlierRounds; ++round) {
    const std::vector<double> residuals = Residuals(centres, alignment.world_from_map);
    const double bound = std::max(kInlierMedians * Median(residuals),
                                  1e-9 * geometry::SpreadOf(centres.world).deviations[2]);
    std::vector<bool> now(pairs.size());
    std::vector<size_t> chosen;
    for (size_t i = 0; i < pairs.size(); ++i) {
      now[i] = residuals[i] <= bound;
      if (now[i]) {
        chosen.push_back(i);
      }
    }
    const std::optional<Similarity3> fit = chosen.size() < 3 ? std::nullopt : Fit(centres, chosen);
    if (!fit) {
      break;
    }
    alignment.world_from_map = *fit;
    if (now == alignment.inliers) {
      break;
    }
    alignment.inliers = now;
  }
  return alignment;
}

std::optional<Alignment> AlignOnPoints(std::span<const PosePair> pairs,
                                       std::span<const Vector3d> points) {
  std::optional<Alignment> alignment = AlignOnCentres(pairs);
  if (alignment) {
    alignment->world_from_map =
        Refine(alignment->world_from_map, PointFit(pairs, alignment->inliers, points));
  }
  return alignment;
}

}  // namespace lararium::player
