#include "editor/train/floor_plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "shared/core/median.h"
#include "shared/core/random.h"
#include "shared/core/units.h"
#include "shared/geometry/point_spread.h"

namespace lararium::train {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using vision::Keyframe;
using vision::SceneDatabase;
constexpr double kMaxFromCameraUp = 35.0 * kRadiansPerDegree;
constexpr double kMaxBetweenLevels = 3.0 * kRadiansPerDegree;  // Tolerance of parallel surfaces.
// Lengths are relative to the median distance of points from the cameras.
constexpr double kPatch = 0.015;        // Points in a cube of this size count once.
constexpr double kTolerance = 0.008;    // Largest distance of a surface's points from its plane.
constexpr double kNeighbourhood = 0.2;  // Largest distance between the three points of a sample.
constexpr double kBlock = 0.15;         // Errors within a cube of this size are correlated.
constexpr int kHypotheses = 400;
constexpr size_t kMinPatches = 40;    // Minimum number of patches of a horizontal surface.
constexpr double kMinShare = 0.2;     // Minimum area, relative to the largest horizontal surface.
constexpr double kMinContrast = 3.0;  // Minimum density, relative to the layers above and below.

struct Plane {
  Vector3d normal;
  double offset = 0.0;

  double Height(const Vector3d& x) const { return normal.dot(x) - offset; }
};

// ------------------------------------------------------------ input

struct Scene {
  std::vector<Vector3d> centers;  // Camera centres.
  Vector3d up;                    // Approximate up direction.
  double distance = 0.0;          // Median distance of points from the cameras.
  std::vector<Vector3d> patches;  // Mean of the points in each cube.
};

// The up direction, assuming that cameras are held upright, so that their x axes are horizontal. If
// all of them look the same way, a circle of directions remains; the mean of their up axes decides.
Vector3d UpOfCameras(std::span<const Keyframe> keyframes) {
  Matrix3d level = Matrix3d::Zero();
  Vector3d mean_up = Vector3d::Zero();
  for (const Keyframe& keyframe : keyframes) {
    const Matrix3d map_from_camera =
        keyframe.camera_from_map.rotation.toRotationMatrix().transpose();
    level += map_from_camera.col(0) * map_from_camera.col(0).transpose();
    mean_up -= map_from_camera.col(1);
  }
  mean_up.normalize();
  level /= static_cast<double>(keyframes.size());
  constexpr double kMeanWeight = 0.05;
  level -= kMeanWeight * mean_up * mean_up.transpose();
  const Vector3d up = Eigen::SelfAdjointEigenSolver<Matrix3d>(level).eigenvectors().col(0);
  return up.dot(mean_up) >= 0.0 ? up : Vector3d(-up);
}

// The median distance between about 1000 evenly chosen points and the cameras.
double MedianDistance(const SceneDatabase& database, std::span<const Vector3d> centers) {
  std::vector<double> distances;
  const size_t step = database.points.size() / 1000 + 1;
  for (size_t i = 0; i < database.points.size(); i += step) {
    for (const Vector3d& center : centers) {
      distances.push_back((database.points[i].cast<double>() - center).norm());
    }
  }
  return Median(std::move(distances));
}

std::tuple<int64_t, int64_t, int64_t> Cube(const Vector3d& x, double size) {
  const Vector3d cell = (x / size).array().floor();
  return {static_cast<int64_t>(cell.x()), static_cast<int64_t>(cell.y()),
          static_cast<int64_t>(cell.z())};
}

std::vector<Vector3d> MakePatches(const SceneDatabase& database, double size) {
  std::map<std::tuple<int64_t, int64_t, int64_t>, std::pair<Vector3d, int>> cubes;
  for (const Eigen::Vector3f& point : database.points) {
    auto& [sum, count] =
        cubes.try_emplace(Cube(point.cast<double>(), size), Vector3d::Zero(), 0).first->second;
    sum += point.cast<double>();
    ++count;
  }
  std::vector<Vector3d> patches;
  for (const auto& [cube, content] : cubes) {
    patches.push_back(content.first / content.second);
  }
  return patches;
}

Scene DescribeScene(const SceneDatabase& database) {
  Scene scene;
  for (const Keyframe& keyframe : database.keyframes) {
    scene.centers.push_back(keyframe.camera_from_map.Center());
  }
  scene.up = UpOfCameras(database.keyframes);
  // The lower limit keeps the integer indices of the cubes in range.
  scene.distance = std::max(MedianDistance(database, scene.centers), 1e-6);
  scene.patches = MakePatches(database, kPatch * scene.distance);
  return scene;
}

// ------------------------------------------------------------ horizontal surfaces

std::optional<Plane> LeastSquaresPlane(std::span<const Vector3d> points, const Vector3d& up) {
  if (points.size() < 3) {
    return std::nullopt;
  }
  const geometry::PointSpread spread = geometry::SpreadOf(points);
  if (!(spread.deviations[1] > 2.0 * spread.deviations[0])) {
    return std::nullopt;  // The points form a line or a cloud.
  }
  const Vector3d normal = spread.axes.col(0);
  const Vector3d upwards = normal.dot(up) >= 0.0 ? normal : Vector3d(-normal);
  return Plane{upwards, upwards.dot(spread.mean)};
}

std::vector<Vector3d> PointsNear(const Plane& plane,
                                 double tolerance,
                                 std::span<const Vector3d> points) {
  std::vector<Vector3d> near;
  for (const Vector3d& point : points) {
    if (std::abs(plane.Height(point)) <= tolerance) {
      near.push_back(point);
    }
  }
  return near;
}

bool IsLevel(const Plane& plane, const Vector3d& up) {
  return plane.normal.dot(up) >= std::cos(kMaxFromCameraUp);
}

// Returns whether at least 95 % of the cameras are above the plane; a few poses may be wrong.
bool CamerasAbove(const Plane& plane, std::span<const Vector3d> centers) {
  const auto above = std::count_if(centers.begin(), centers.end(),
                                   [&](const Vector3d& c) { return plane.Height(c) > 0.0; });
  return static_cast<double>(above) >= 0.95 * static_cast<double>(centers.size());
}

// A plane through three neighbouring points, refined with the points near it.
std::optional<Plane> LocalPlane(const Scene& scene, Random& random) {
  const std::vector<Vector3d>& patches = scene.patches;
  const auto draw = [&](const std::vector<Vector3d>& from) {
    return from[random.Below(static_cast<uint32_t>(from.size()))];
  };
  const Vector3d seed = draw(patches);
  const double radius = kNeighbourhood * scene.distance;
  std::vector<Vector3d> around;
  for (const Vector3d& patch : patches) {
    if ((patch - seed).squaredNorm() < radius * radius) {
      around.push_back(patch);
    }
  }
  const Vector3d a = draw(around);
  const Vector3d b = draw(around);
  const Vector3d cross = (a - seed).cross(b - seed);
  if (!(cross.norm() > 0.05 * radius * radius)) {
    return std::nullopt;
  }
  const Vector3d normal = cross.normalized() * (cross.dot(scene.up) >= 0.0 ? 1.0 : -1.0);
  const Plane rough{normal, normal.dot(seed)};
  return LeastSquaresPlane(PointsNear(rough, kTolerance * scene.distance, around), scene.up);
}

// The largest horizontal surface below the cameras, by RANSAC with local optimisation (Chum, Matas
// & Kittler, "Locally Optimized RANSAC", DAGM 2003).
std::optional<Plane> LargestLevelPlane(const Scene& scene, uint64_t seed) {
  Random random(seed);
  const double tolerance = kTolerance * scene.distance;
  std::optional<Plane> best;
  size_t best_support = 0;
  for (int i = 0; i < kHypotheses; ++i) {
    std::optional<Plane> plane = LocalPlane(scene, random);
    for (int round = 0; round < 4 && plane && IsLevel(*plane, scene.up); ++round) {
      const std::vector<Vector3d> support = PointsNear(*plane, tolerance, scene.patches);
      if (support.size() > best_support && CamerasAbove(*plane, scene.centers)) {
        best = plane;
        best_support = support.size();
      } else if (2 * support.size() < best_support) {
        break;  // Refinement cannot make up for so little support.
      }
      plane = LeastSquaresPlane(support, scene.up);
    }
  }
  return best_support >= kMinPatches ? best : std::nullopt;
}

// ------------------------------------------------------------ the lowest surface

// Number of sorted heights within [from, to).
size_t CountBetween(std::span<const double> sorted, double from, double to) {
  return static_cast<size_t>(std::lower_bound(sorted.begin(), sorted.end(), to) -
                             std::lower_bound(sorted.begin(), sorted.end(), from));
}

// The height, relative to the given plane, of the lowest layer that is as densely filled as a
// surface; nullopt if not even the given plane is.
std::optional<double> LowestLevel(const Plane& largest, const Scene& scene) {
  const double tolerance = kTolerance * scene.distance;
  std::vector<double> heights;
  for (const Vector3d& patch : scene.patches) {
    heights.push_back(largest.Height(patch));
  }
  std::sort(heights.begin(), heights.end());
  const size_t most = CountBetween(heights, -tolerance, tolerance);
  const double wanted =
      std::max(static_cast<double>(kMinPatches), kMinShare * static_cast<double>(most));
  for (const double height : heights) {
    if (height > 0.0) {
      break;
    }
    const size_t here = CountBetween(heights, height, height + 2.0 * tolerance);
    // Walls and clutter fill all heights evenly; a surface stands out from them.
    const size_t below = CountBetween(heights, height - 4.0 * tolerance, height);
    const size_t above = CountBetween(heights, height + 2.0 * tolerance, height + 6.0 * tolerance);
    const double background = 0.5 * static_cast<double>(std::max(below, above));
    if (static_cast<double>(here) >= wanted &&
        static_cast<double>(here) >= kMinContrast * background) {
      return height + tolerance;
    }
  }
  return std::nullopt;
}

// ------------------------------------------------------------ the final fit

// Points in the axes of a plane: position on the plane and height above it.
struct Heights {
  Vector3d origin;
  Matrix3d axes;  // Columns: two axes along the plane, and the normal.
  std::vector<Vector3d> points;

  Heights(const Plane& plane, std::span<const Vector3d> near) {
    origin = Vector3d::Zero();
    for (const Vector3d& point : near) {
      origin += point / static_cast<double>(near.size());
    }
    axes.col(2) = plane.normal;
    axes.col(0) = plane.normal.unitOrthogonal();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    for (const Vector3d& point : near) {
      points.push_back(axes.transpose() * (point - origin));
    }
  }
};

struct FloorFit {
  Vector3d slope = Vector3d::Zero();  // height = slope . (u, v, 1)
  double spread = 0.0;
  std::vector<double> weights;

  double Residual(const Vector3d& point) const {
    return point.z() - slope.dot(Vector3d(point.x(), point.y(), 1.0));
  }
};

// Iteratively reweighted least squares with Tukey's biweight; the scale comes from the median
// absolute residual. The constant is smaller than the usual 4.685, because objects on the floor
// produce outliers on one side only.
FloorFit FitRobustly(const Heights& heights) {
  constexpr double kTukey = 3.0;
  constexpr int kRounds = 20;
  FloorFit fit;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> residuals;
    for (const Vector3d& point : heights.points) {
      residuals.push_back(std::abs(fit.Residual(point)));
    }
    fit.spread = std::max(1.4826 * Median(residuals), 1e-12);
    Matrix3d normal = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    fit.weights.assign(heights.points.size(), 0.0);
    for (size_t i = 0; i < heights.points.size(); ++i) {
      const double ratio = residuals[i] / (kTukey * fit.spread);
      const double weight = ratio < 1.0 ? std::pow(1.0 - ratio * ratio, 2) : 0.0;
      const Vector3d row(heights.points[i].x(), heights.points[i].y(), 1.0);
      fit.weights[i] = weight;
      normal += weight * row * row.transpose();
      right += weight * heights.points[i].z() * row;
    }
    fit.slope = normal.ldlt().solve(right);
  }
  return fit;
}

// Standard deviation of the slope about its least certain axis: the sandwich estimate over blocks
// of points (Liang & Zeger, "Longitudinal data analysis using generalized linear models",
// Biometrika 1986).
double SlopeDeviation(const Heights& heights, const FloorFit& fit, double block) {
  Matrix3d normal = Matrix3d::Zero();
  std::map<std::pair<int64_t, int64_t>, Vector3d> scores;
  for (size_t i = 0; i < heights.points.size(); ++i) {
    const Vector3d& point = heights.points[i];
    const Vector3d row(point.x(), point.y(), 1.0);
    normal += fit.weights[i] * row * row.transpose();
    const std::pair<int64_t, int64_t> at(static_cast<int64_t>(std::floor(point.x() / block)),
                                         static_cast<int64_t>(std::floor(point.y() / block)));
    scores.try_emplace(at, Vector3d::Zero()).first->second +=
        fit.weights[i] * fit.Residual(point) * row;
  }
  Matrix3d meat = Matrix3d::Zero();
  for (const auto& [at, score] : scores) {
    meat += score * score.transpose();
  }
  const Matrix3d bread = normal.inverse();
  const Matrix3d covariance = bread * meat * bread;
  const Eigen::Matrix2d slopes = covariance.topLeftCorner<2, 2>();
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(slopes).eigenvalues()[1]);
}

// The points without those at the foot of walls and objects: removes the cells of the plane above
// which something stands, and their neighbours.
std::vector<Vector3d> WithoutFeet(const Plane& level,
                                  std::span<const Vector3d> near,
                                  const Scene& scene) {
  const double tolerance = kTolerance * scene.distance;
  const double size = 2.0 * kPatch * scene.distance;
  const Vector3d u = level.normal.unitOrthogonal();
  const Vector3d v = level.normal.cross(u);
  const auto column = [&](const Vector3d& x) {
    return std::pair(static_cast<int64_t>(std::floor(u.dot(x) / size)),
                     static_cast<int64_t>(std::floor(v.dot(x) / size)));
  };
  std::set<std::pair<int64_t, int64_t>> taken;
  for (const Vector3d& patch : scene.patches) {
    const double height = level.Height(patch);
    if (height > 3.0 * tolerance && height < 12.0 * tolerance) {
      const auto [column_u, column_v] = column(patch);
      for (int64_t around = 0; around < 9; ++around) {
        taken.emplace(column_u + around % 3 - 1, column_v + around / 3 - 1);
      }
    }
  }
  std::vector<Vector3d> free;
  for (const Vector3d& point : near) {
    if (!taken.contains(column(point))) {
      free.push_back(point);
    }
  }
  return free;
}

// Fits the floor to the points near the level. nullopt if they do not form a surface by themselves.
std::optional<FloorPlane> FitFloor(const Plane& level, const Scene& scene) {
  const double tolerance = kTolerance * scene.distance;
  std::vector<Vector3d> near = PointsNear(level, 2.0 * tolerance, scene.patches);
  if (near.size() < kMinPatches) {
    return std::nullopt;
  }
  if (std::vector<Vector3d> free = WithoutFeet(level, near, scene); free.size() >= kMinPatches) {
    near = std::move(free);
  }
  const Heights heights(level, near);
  const FloorFit fit = FitRobustly(heights);
  const double tilt = std::atan(fit.slope.head<2>().norm());
  if (!(tilt < kMaxBetweenLevels)) {
    return std::nullopt;
  }
  FloorPlane floor;
  floor.normal = (heights.axes * Vector3d(-fit.slope.x(), -fit.slope.y(), 1.0)).normalized();
  floor.center = heights.origin + fit.slope.z() * heights.axes.col(2);
  floor.offset = floor.normal.dot(floor.center);
  double squares = 0.0;
  for (const Vector3d& point : heights.points) {
    squares += point.head<2>().squaredNorm();
  }
  floor.radius = std::sqrt(squares / static_cast<double>(heights.points.size()));
  floor.spread = fit.spread;
  floor.tilt_deviation = SlopeDeviation(heights, fit, kBlock * scene.distance);
  return floor;
}

}  // namespace

std::optional<FloorPlane> FindFloor(const SceneDatabase& database, uint64_t seed) {
  if (database.points.empty() || database.keyframes.empty()) {
    return std::nullopt;
  }
  const Scene scene = DescribeScene(database);
  const std::optional<Plane> largest =
      scene.patches.size() >= kMinPatches ? LargestLevelPlane(scene, seed) : std::nullopt;
  if (!largest) {
    return std::nullopt;
  }
  const std::optional<double> height = LowestLevel(*largest, scene);
  if (!height) {
    return std::nullopt;
  }
  std::optional<FloorPlane> floor = FitFloor({largest->normal, largest->offset + *height}, scene);
  if (floor) {
    floor->points = static_cast<int>(
        std::count_if(database.points.begin(), database.points.end(), [&](const auto& point) {
          return std::abs(floor->Height(point.template cast<double>())) <= 3.0 * floor->spread;
        }));
  }
  return floor;
}

}  // namespace lararium::train
