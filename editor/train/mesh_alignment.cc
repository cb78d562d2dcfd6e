#include "editor/train/mesh_alignment.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <string>
#include <unordered_map>
#include <vector>

#include "shared/core/parallel.h"
#include "shared/core/random.h"
#include "shared/geometry/glm_convert.h"
#include "shared/geometry/point_spread.h"
#include "shared/vision/occluders.h"

namespace lararium::train {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using geometry::Similarity3;

constexpr double kThin = 0.03;      // Points with a smaller ratio of breadth to length are a line.
constexpr double kNarrowest = 0.1;  // Final search distance, as a share of search_m.
// Initial search distances, as shares of search_m. With a large one, objects that stand on the
// model draw it away; a model that already lies well is refined better with a small one.
constexpr double kBeginnings[] = {1.0, 0.4, 0.15};
constexpr double kShrink = 0.8;
constexpr int kRounds = 6;             // Maximum number of steps at each search distance.
constexpr size_t kMaxPoints = 20'000;  // Maximum number of points used; more add no information.
// A direction is undetermined if its eigenvalue of the mean normal matrix, with motion in metres,
// is smaller.
constexpr double kUndetermined = 3e-3;

// Ratio of breadth to length of a set of points.
double Thinness(std::span<const Vector3d> points) {
  const Vector3d deviations = geometry::SpreadOf(points).deviations;
  return deviations[2] > 0.0 ? deviations[1] / deviations[2] : 0.0;
}

std::string Metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", length);
  return text;
}

// Refines the alignment of a model with the map points near it.
class Refiner {
 public:
  Refiner(const geometry::TriangleMesh& mesh,
          const Similarity3& stage_from_mesh,
          std::span<const Vector3d> points,
          const RefineOptions& options)
      : mesh_(mesh), tree_(vision::Placed(mesh, {})), start_(stage_from_mesh), options_(options) {
    // The model moves by at most search_m, so points beyond twice that distance never come near.
    std::vector<char> near(points.size());
    ForChunks(points.size(), [&](size_t i) {
      near[i] = FindPair(points[i], start_, 2.0 * options_.search_m).has_value() ? 1 : 0;
    });
    for (size_t i = 0; i < points.size(); ++i) {
      if (near[i] != 0) {
        points_.push_back(points[i]);
      }
    }
    Random random(1);
    for (size_t i = 0; i < kMaxPoints && points_.size() > kMaxPoints; ++i) {
      std::swap(points_[i], points_[i + random.Below(static_cast<uint32_t>(points_.size() - i))]);
    }
    points_.resize(std::min(points_.size(), kMaxPoints));
  }

  // Refines from each initial search distance and keeps the result with most points on the surface.
  Result<RefineReport> Run(Progress& progress) {
    std::optional<Fit> best;
    double most = 0.0;
    Status failed;
    for (size_t i = 0; i < std::size(kBeginnings); ++i) {
      progress.Report("moving the model",
                      static_cast<double>(i) / static_cast<double>(std::size(kBeginnings)));
      fit_ = {start_};
      const Status settled = Settle(kBeginnings[i] * options_.search_m, progress);
      if (progress.Cancelled()) {
        return Status::Error("model", "cancelled");
      }
      if (!settled.ok()) {
        failed = failed.ok() ? settled : failed;
      } else if (const double weights = Weights(kNarrowest * options_.search_m); weights >= most) {
        best = fit_;
        most = weights;
      }
    }
    if (!best) {
      return failed;
    }
    fit_ = *std::move(best);
    return Report();
  }

 private:
  // The current alignment.
  struct Fit {
    Similarity3 stage_from_mesh;
    std::vector<SurfacePair> pairs = {};  // One for each point near the surface.
    int undetermined = 0;
  };

  template <typename Body>
  static void ForChunks(size_t count, const Body& body) {
    constexpr size_t kChunk = 512;
    ParallelFor((count + kChunk - 1) / kChunk, [&](size_t chunk) {
      for (size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
        body(i);
      }
    });
  }

  // Refines the alignment with a shrinking search distance.
  Status Settle(double search, Progress& progress) {
    LARARIUM_RETURN_IF_ERROR(Match(search));
    while (true) {
      for (int round = 0; round < kRounds && !progress.Cancelled(); ++round) {
        const double step = Move(search);
        LARARIUM_RETURN_IF_ERROR(Match(search));
        if (step < 1e-4 * options_.search_m) {
          break;
        }
      }
      if (search <= kNarrowest * options_.search_m || progress.Cancelled()) {
        return Status();
      }
      search = std::max(kShrink * search, kNarrowest * options_.search_m);
      LARARIUM_RETURN_IF_ERROR(Match(search));
    }
  }

  // Tukey's weight.
  static double WeightOf(double distance, double search) {
    const double share = 1.0 - std::pow(distance / search, 2);
    return share > 0.0 ? share * share : 0.0;
  }

  // Sum of the weights of all near points, by their distance from the surface.
  double Weights(double search) const {
    double weights = 0.0;
    for (const SurfacePair& pair : fit_.pairs) {
      weights += WeightOf((pair.point - pair.on_surface).norm(), search);
    }
    return weights;
  }

  std::optional<SurfacePair> FindPair(const Vector3d& point,
                                      const Similarity3& stage_from_mesh,
                                      double within_m) const {
    const Vector3d in_mesh = stage_from_mesh.Inverse() * point;
    const auto nearest = tree_.NearestTo(in_mesh.cast<float>(),
                                         static_cast<float>(within_m / stage_from_mesh.scale));
    if (!nearest) {
      return std::nullopt;
    }
    return SurfacePair{point, stage_from_mesh * nearest->point.cast<double>(),
                       stage_from_mesh.rotation * nearest->normal.cast<double>()};
  }

  // Returns whether the point lies in front of or behind the surface. Points beside an edge of an
  // open surface would draw the edge towards them. Points on the surface always count, because
  // their direction from it is undefined.
  bool LiesBefore(const SurfacePair& pair) const {
    constexpr double kFacing = 0.7;  // Cosine of the largest angle to the normal.
    const Vector3d way = pair.point - pair.on_surface;
    return std::abs(way.dot(pair.normal)) >= kFacing * way.norm() ||
           way.norm() < 0.02 * options_.search_m;
  }

  Status Match(double search) {
    std::vector<std::optional<SurfacePair>> found(points_.size());
    ForChunks(points_.size(), [&](size_t i) {
      found[i] = FindPair(points_[i], fit_.stage_from_mesh, search);
      if (found[i] && !LiesBefore(*found[i])) {
        found[i].reset();
      }
    });
    fit_.pairs.clear();
    for (const std::optional<SurfacePair>& pair : found) {
      if (pair) {
        fit_.pairs.push_back(*pair);
      }
    }
    if (fit_.pairs.size() < static_cast<size_t>(options_.min_points)) {
      return Status::Error("model",
                           std::to_string(fit_.pairs.size()) + " points of the map lie within " +
                               Metres(search) + " of its surface; at least " +
                               std::to_string(options_.min_points) + " are needed",
                           "move it closer, align it by points, or look farther");
    }
    return Status();
  }

  // Moves the model by one least-squares step. Returns how far its surface moved, metres.
  double Move(double search) {
    Vector3d center = Vector3d::Zero();
    for (const SurfacePair& pair : fit_.pairs) {
      center += pair.on_surface / static_cast<double>(fit_.pairs.size());
    }
    double reach = 0.0;
    for (const SurfacePair& pair : fit_.pairs) {
      reach += (pair.on_surface - center).squaredNorm() / static_cast<double>(fit_.pairs.size());
    }
    reach = std::max(std::sqrt(reach), 1e-9);
    // Expresses rotation and scale by the motion of points at distance reach, so that all
    // components are in metres.
    SurfaceMotion unit = SurfaceMotion::Constant(1.0 / reach);
    unit.segment<3>(3).setOnes();
    Eigen::Matrix<double, 7, 7> squares = Eigen::Matrix<double, 7, 7>::Zero();
    SurfaceMotion slope = SurfaceMotion::Zero();
    double weights = 0.0;
    for (const SurfacePair& pair : fit_.pairs) {
      const double distance = PlaneDistance(pair, center, SurfaceMotion::Zero());
      const double weight = WeightOf(distance, search);
      const SurfaceMotion derivative = PlaneDistanceDerivative(pair, center).cwiseProduct(unit);
      squares += weight * derivative * derivative.transpose();
      slope += weight * distance * derivative;
      weights += weight;
    }
    if (!(weights > 0.0)) {
      return 0.0;
    }
    const SurfaceMotion motion = Solve(squares / weights, slope / weights).cwiseProduct(unit);
    fit_.stage_from_mesh = MotionAbout(center, motion) * fit_.stage_from_mesh;
    return motion.segment<3>(3).norm() + reach * (motion.head<3>().norm() + std::abs(motion[6]));
  }

  // Solves squares x = -slope in the directions that are determined.
  SurfaceMotion Solve(const Eigen::Matrix<double, 7, 7>& squares, const SurfaceMotion& slope) {
    const Eigen::Index size = options_.keep_scale ? 6 : 7;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        Eigen::MatrixXd(squares.topLeftCorner(size, size)));
    SurfaceMotion motion = SurfaceMotion::Zero();
    fit_.undetermined = 0;
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::VectorXd direction = eigen.eigenvectors().col(i);
      if (eigen.eigenvalues()[i] < kUndetermined) {
        ++fit_.undetermined;
      } else {
        motion.head(size) -= direction * (direction.dot(slope.head(size)) / eigen.eigenvalues()[i]);
      }
    }
    return motion;
  }

  Result<RefineReport> Report() const {
    RefineReport report;
    report.stage_from_mesh = fit_.stage_from_mesh;
    report.points = static_cast<int>(fit_.pairs.size());
    report.undetermined = fit_.undetermined;
    for (const glm::vec3& vertex : mesh_.positions) {
      const Vector3d at = geometry::ToEigen(vertex);
      report.moved_m = std::max(report.moved_m, (fit_.stage_from_mesh * at - start_ * at).norm());
    }
    if (!(report.moved_m <= options_.search_m)) {
      return Status::Error("model",
                           "would move by " + Metres(report.moved_m) +
                               ", farther than the search distance of " + Metres(options_.search_m),
                           "move it closer, align it by points, or look farther");
    }
    const auto squared_at = [&](const Vector3d& point, const Similarity3& stage_from_mesh) {
      const auto pair = FindPair(point, stage_from_mesh, 4.0 * options_.search_m);
      return pair ? (pair->point - pair->on_surface).squaredNorm() : 0.0;
    };
    for (const SurfacePair& pair : fit_.pairs) {
      report.rms_before_m += squared_at(pair.point, start_);
      report.rms_after_m += squared_at(pair.point, fit_.stage_from_mesh);
    }
    report.rms_before_m = std::sqrt(report.rms_before_m / report.points);
    report.rms_after_m = std::sqrt(report.rms_after_m / report.points);
    report.covered = Covered();
    return report;
  }

  // Share of the surface that has map points within search_m, estimated from sample points.
  double Covered() const {
    const double cell = options_.search_m;
    const auto key = [&](const Vector3d& at, int dx, int dy, int dz) {
      const auto part = [&](double value, int d) {
        return (static_cast<uint64_t>(static_cast<int64_t>(std::floor(value / cell)) + d)) &
               0x1fffff;
      };
      return part(at.x(), dx) << 42 | part(at.y(), dy) << 21 | part(at.z(), dz);
    };
    std::unordered_multimap<uint64_t, Vector3d> cells;
    for (const SurfacePair& pair : fit_.pairs) {
      cells.emplace(key(pair.on_surface, 0, 0, 0), pair.on_surface);
    }
    const auto covered = [&](const Vector3d& at) {
      for (int n = 0; n < 27; ++n) {
        const auto [begin, end] = cells.equal_range(key(at, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
        if (std::any_of(begin, end,
                        [&](const auto& entry) { return (entry.second - at).norm() <= cell; })) {
          return true;
        }
      }
      return false;
    };
    const std::vector<Vector3d> strewn = Strew();
    const auto count = std::count_if(strewn.begin(), strewn.end(), covered);
    return static_cast<double>(count) / static_cast<double>(strewn.size());
  }

  // Sample points of the surface, distributed evenly by area; stage metres.
  std::vector<Vector3d> Strew() const {
    constexpr size_t kCount = 2000;
    const auto corner = [&](size_t i) {
      return geometry::ToEigen(mesh_.positions[mesh_.indices[i]]);
    };
    std::vector<double> areas;  // Cumulative (double) areas of the triangles.
    double area = 0.0;
    for (size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
      area += (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i)).norm();
      areas.push_back(area);
    }
    Random random(2);
    std::vector<Vector3d> points;
    for (size_t n = 0; n < kCount; ++n) {
      const auto at = std::upper_bound(areas.begin(), areas.end(), area * random.Uniform());
      const auto i = 3 * static_cast<size_t>(std::min(at, areas.end() - 1) - areas.begin());
      double u = random.Uniform();
      double v = random.Uniform();
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      points.push_back(fit_.stage_from_mesh * (corner(i) + u * (corner(i + 1) - corner(i)) +
                                               v * (corner(i + 2) - corner(i))));
    }
    return points;
  }

  const geometry::TriangleMesh& mesh_;
  vision::OccluderTree tree_;  // Mesh coordinates.
  Similarity3 start_;
  RefineOptions options_;
  std::vector<Vector3d> points_;  // Map points that may come near the model, stage metres.
  Fit fit_;
};

}  // namespace

Result<Similarity3> AlignByPairs(std::span<const MeshPair> pairs, std::optional<double> scale) {
  std::vector<Vector3d> on_mesh;
  std::vector<Vector3d> on_stage;
  for (const MeshPair& pair : pairs) {
    on_mesh.push_back(pair.on_mesh);
    on_stage.push_back(pair.on_stage);
  }
  if (pairs.size() < 3) {
    return Status::Error("model",
                         std::to_string(pairs.size()) +
                             " of its points are known in the place; at least 3 are needed",
                         "add pairs");
  }
  if (Thinness(on_mesh) < kThin || Thinness(on_stage) < kThin) {
    return Status::Error("model", "the points lie on a line, or nearly so",
                         "add one well beside it");
  }
  LARARIUM_ASSIGN_OR_RETURN(Similarity3 stage_from_mesh,
                            geometry::EstimateSimilarity(on_stage, on_mesh));
  if (scale) {
    // The best rotation does not depend on the scale.
    stage_from_mesh.scale = *scale;
    stage_from_mesh.translation.setZero();
    Vector3d shift = Vector3d::Zero();
    for (const MeshPair& pair : pairs) {
      shift += (pair.on_stage - stage_from_mesh * pair.on_mesh) / static_cast<double>(pairs.size());
    }
    stage_from_mesh.translation = shift;
  }
  return stage_from_mesh;
}

Similarity3 MotionAbout(const Vector3d& center, const SurfaceMotion& motion) {
  Similarity3 moved;
  moved.scale = std::exp(motion[6]);
  moved.rotation = geometry::RotationFromVector(motion.head<3>());
  moved.translation = center + motion.segment<3>(3) - moved.scale * (moved.rotation * center);
  return moved;
}

double PlaneDistance(const SurfacePair& pair, const Vector3d& center, const SurfaceMotion& motion) {
  const Similarity3 moved = MotionAbout(center, motion);
  return (moved.rotation * pair.normal).dot(pair.point - moved * pair.on_surface);
}

SurfaceMotion PlaneDistanceDerivative(const SurfacePair& pair, const Vector3d& center) {
  SurfaceMotion derivative;
  derivative.head<3>() = pair.normal.cross(pair.point - center);
  derivative.segment<3>(3) = -pair.normal;
  derivative[6] = -pair.normal.dot(pair.on_surface - center);
  return derivative;
}

Status RefineOptions::Validate() const {
  if (!(search_m > 0.0) || !std::isfinite(search_m)) {
    return Status::Error("search distance", "must be more than 0 m");
  }
  if (min_points < 6) {
    return Status::Error("points", "at least six are needed to align a model");
  }
  return Status();
}

Result<RefineReport> RefineAlignment(const geometry::TriangleMesh& mesh,
                                     const Similarity3& stage_from_mesh,
                                     std::span<const Vector3d> points,
                                     const RefineOptions& options,
                                     Progress& progress) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  LARARIUM_RETURN_IF_ERROR(mesh.Validate("model"));
  const auto has_area = [&](size_t i) {
    const auto corner = [&](size_t k) {
      return geometry::ToEigen(mesh.positions[mesh.indices[i + k]]);
    };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).squaredNorm() > 0.0;
  };
  bool any = false;
  for (size_t i = 0; i + 2 < mesh.indices.size() && !any; i += 3) {
    any = has_area(i);
  }
  if (!any) {
    return Status::Error("model", "has no surface");
  }
  progress.Report("looking for points near the model", 0.0);
  return Refiner(mesh, stage_from_mesh, points, options).Run(progress);
}

}  // namespace lararium::train
