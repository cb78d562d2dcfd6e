#include "shared/stage/picks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "shared/core/units.h"
#include "shared/geometry/point_spread.h"
#include "shared/geometry/triangulation.h"

namespace lararium::stage {
namespace {

using vision::Keyframe;
using vision::SceneDatabase;
constexpr double kMinTriangulationAngle = 1.0 * kRadiansPerDegree;
constexpr double kMinCorner =
    3.0 * kRadiansPerDegree;  // Angle at the origin between `forward` and `floor`.
constexpr double kMinGrazing =
    5.0 * kRadiansPerDegree;  // Angle between a single pick's ray and its plane.
constexpr size_t kMaxPlanePoints = 24;
constexpr size_t kMinPlanePoints = 6;
constexpr double kPlaneRadius = 0.15;  // Fraction of the image width.

// A pick that lies in a keyframe of the map.
struct Observation {
  uint32_t keyframe = 0;
  Eigen::Vector2d pixel;
};

struct Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;  // normal . x = offset

  double Distance(const Eigen::Vector3d& x) const { return std::abs(normal.dot(x) - offset); }
};

Status Problem(const Anchor& anchor, std::string_view problem, std::string_view remedy) {
  return Status::Error("stage: '" + anchor.name + "'", problem, remedy);
}

std::optional<Observation> FindObservation(const Pick& pick, const SceneDatabase& database) {
  const auto found = std::find_if(database.keyframes.begin(), database.keyframes.end(),
                                  [&](const Keyframe& keyframe) { return LiesIn(pick, keyframe); });
  if (found == database.keyframes.end() || !database.camera.Contains(pick.pixel)) {
    return std::nullopt;
  }
  return Observation{static_cast<uint32_t>(found - database.keyframes.begin()), pick.pixel};
}

std::vector<Observation> FindObservations(const Anchor& anchor, const SceneDatabase& database) {
  std::vector<Observation> observations;
  for (const Pick& pick : anchor.picks) {
    if (const std::optional<Observation> observation = FindObservation(pick, database)) {
      observations.push_back(*observation);
    }
  }
  return observations;
}

std::string FrameName(const Pick& pick) {
  const std::string frame = pick.frame.empty() ? std::to_string(pick.frame_index) : pick.frame;
  return pick.session == 0 ? frame : frame + " of session " + std::to_string(pick.session);
}

std::vector<std::string> FramesLeftOut(const Anchor& anchor, const SceneDatabase& database) {
  std::vector<std::string> frames;
  for (const Pick& pick : anchor.picks) {
    if (!FindObservation(pick, database)) {
      frames.push_back(FrameName(pick));
    }
  }
  return frames;
}

// The problem that no pick lies in a keyframe of this map, with the frames of the picks.
std::string NoObservation(const Anchor& anchor, const SceneDatabase& database) {
  std::string text = "no pick lies in a keyframe of this map";
  const std::vector<std::string> frames = FramesLeftOut(anchor, database);
  constexpr size_t kMaxNamed = 4;
  for (size_t i = 0; i < std::min(frames.size(), kMaxNamed); ++i) {
    text += (i == 0 ? " (they lie in " : ", ") + frames[i];
  }
  text += frames.size() > kMaxNamed ? ", ..." : "";
  return frames.empty() ? text : text + ")";
}

// Pixels and indices of the map points that a keyframe sees. A keyframe that was used to build the
// map has observations; for one that was located later, the points that face it are projected.
std::vector<std::pair<Eigen::Vector2d, uint32_t>> SeenPoints(uint32_t keyframe,
                                                             const SceneDatabase& database) {
  std::vector<std::pair<Eigen::Vector2d, uint32_t>> seen;  // Pixel and index into `points`.
  const auto begin = std::lower_bound(
      database.observations.begin(), database.observations.end(), keyframe,
      [](const vision::Observation& o, uint32_t wanted) { return o.keyframe < wanted; });
  for (auto o = begin; o != database.observations.end() && o->keyframe == keyframe; ++o) {
    seen.emplace_back(Eigen::Vector2d(o->x, o->y), o->point);
  }
  const geometry::Rigid3& camera_from_map = database.keyframes[keyframe].camera_from_map;
  const Eigen::Vector3d center = camera_from_map.Center();
  if (!seen.empty()) {
    return seen;
  }
  for (uint32_t p = 0; p < database.normals.size(); ++p) {
    const Eigen::Vector3d point = database.points[p].cast<double>();
    const auto pixel = database.camera.Project(camera_from_map * point);
    if (pixel && database.normals[p].cast<double>().dot(center - point) > 0.0) {
      seen.emplace_back(*pixel, p);
    }
  }
  return seen;
}

// Map points around the pixel of an observation, nearest first.
std::vector<Eigen::Vector3d> PointsAround(const Observation& observation,
                                          const SceneDatabase& database) {
  std::vector<std::pair<double, uint32_t>> near;  // Distance in pixels and index into `points`.
  for (const auto& [pixel, point] : SeenPoints(observation.keyframe, database)) {
    const double distance = (pixel - observation.pixel).norm();
    if (distance <= kPlaneRadius * database.camera.width) {
      near.emplace_back(distance, point);
    }
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMaxPlanePoints));
  std::vector<Eigen::Vector3d> points;
  for (const auto& [distance, point] : near) {
    points.push_back(database.points[point].cast<double>());
  }
  return points;
}

double MedianDistance(const Plane& plane,
                      std::span<const Eigen::Vector3d> points,
                      std::vector<double>& distances) {
  distances.clear();
  for (const Eigen::Vector3d& point : points) {
    distances.push_back(plane.Distance(point));
  }
  const auto middle = distances.begin() + static_cast<ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

std::optional<Plane> PlaneThrough(const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
  const Eigen::Vector3d cross = (b - a).cross(c - a);
  const double size = (b - a).norm() * (c - a).norm();
  if (!(cross.norm() > 0.05 * size)) {
    return std::nullopt;
  }
  const Eigen::Vector3d normal = cross.normalized();
  return Plane{normal, normal.dot(a)};
}

Plane LeastSquaresPlane(std::span<const Eigen::Vector3d> points) {
  const geometry::PointSpread spread = geometry::SpreadOf(points);
  const Eigen::Vector3d normal = spread.axes.col(0);
  return {normal, normal.dot(spread.mean)};
}

// Least median of squares (Rousseeuw, "Least Median of Squares Regression", JASA 1984) over all
// triples, then least squares on the inliers. Tolerates up to half of the points as outliers.
std::optional<Plane> FitPlane(std::span<const Eigen::Vector3d> points) {
  std::optional<Plane> best;
  double best_median = 0.0;
  std::vector<double> distances;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = i + 1; j < points.size(); ++j) {
      for (size_t k = j + 1; k < points.size(); ++k) {
        const std::optional<Plane> plane = PlaneThrough(points[i], points[j], points[k]);
        const double median = plane ? MedianDistance(*plane, points, distances) : 0.0;
        if (plane && (!best || median < best_median)) {
          best = plane;
          best_median = median;
        }
      }
    }
  }
  if (!best) {
    return std::nullopt;
  }
  std::vector<Eigen::Vector3d> inliers;
  const double robust_deviation = 1.4826 * best_median;
  for (const Eigen::Vector3d& point : points) {
    if (best->Distance(point) <= 2.5 * robust_deviation) {
      inliers.push_back(point);
    }
  }
  return inliers.size() < 4 ? best : LeastSquaresPlane(inliers);
}

Result<Eigen::Vector3d> PointOnPlane(const Anchor& anchor,
                                     const Observation& observation,
                                     const SceneDatabase& database) {
  constexpr char kRemedy[] = "pick it in a second training image as well";
  const std::vector<Eigen::Vector3d> points = PointsAround(observation, database);
  if (points.size() < kMinPlanePoints) {
    return Problem(anchor, "there is only one pick, with too few points of the map around it",
                   kRemedy);
  }
  const std::optional<Plane> plane = FitPlane(points);
  if (!plane) {
    return Problem(anchor,
                   "there is only one pick, and the points of the map around it lie on a line",
                   kRemedy);
  }
  const geometry::Rigid3 map_from_camera =
      database.keyframes[observation.keyframe].camera_from_map.Inverse();
  const Eigen::Vector2d on_plane = database.camera.PlaneFromPixel(observation.pixel);
  const Eigen::Vector3d ray = (map_from_camera.rotation * on_plane.homogeneous()).normalized();
  const Eigen::Vector3d& center = map_from_camera.translation;
  const double sine = plane->normal.dot(ray);
  const double depth = (plane->offset - plane->normal.dot(center)) / sine;
  if (std::abs(sine) < std::sin(kMinGrazing) || depth <= 0.0) {
    return Problem(anchor, "there is only one pick, in an image that shows the surface edge on",
                   kRemedy);
  }
  return Eigen::Vector3d(center + depth * ray);
}

Result<Eigen::Vector3d> LocateAnchor(const Anchor& anchor,
                                     std::span<const Observation> observations,
                                     const SceneDatabase& database) {
  if (observations.empty()) {
    return Problem(anchor, NoObservation(anchor, database),
                   "pick it in one of the keyframes, better in two");
  }
  if (observations.size() == 1) {
    return PointOnPlane(anchor, observations[0], database);
  }
  std::vector<geometry::Rigid3> cameras;
  std::vector<Eigen::Vector2d> plane_points;
  for (const Observation& observation : observations) {
    cameras.push_back(database.keyframes[observation.keyframe].camera_from_map);
    plane_points.push_back(database.camera.PlaneFromPixel(observation.pixel));
  }
  const std::optional<Eigen::Vector3d> point = geometry::TriangulatePoint(cameras, plane_points);
  if (!point) {
    return Problem(anchor, "the picks do not meet in a point in front of the cameras",
                   "pick the same point in keyframes taken from different places");
  }
  return *point;
}

double ReprojectionError(std::span<const Observation> observations,
                         const Eigen::Vector3d& point,
                         const SceneDatabase& database) {
  double sum = 0.0;
  for (const Observation& observation : observations) {
    const geometry::Rigid3& camera_from_map =
        database.keyframes[observation.keyframe].camera_from_map;
    const auto pixel = database.camera.Project(camera_from_map * point);
    sum += pixel ? (*pixel - observation.pixel).squaredNorm() : 0.0;
  }
  return std::sqrt(sum / static_cast<double>(observations.size()));
}

// Variance of a quantity that depends on the anchor's point, if each coordinate of each pick has a
// standard deviation of one pixel: the sum of its squared changes, by central differences over half
// pixels through the whole solution. squared_change(a, b) is the squared change from point a to
// point b.
template <typename SquaredChange>
double Variance(const Anchor& anchor,
                const SceneDatabase& database,
                const SquaredChange& squared_change) {
  double variance = 0.0;
  std::vector<Observation> observations = FindObservations(anchor, database);
  for (Observation& observation : observations) {
    for (int axis = 0; axis < 2; ++axis) {
      const double exact = observation.pixel[axis];
      observation.pixel[axis] = exact - 0.5;
      const Result<Eigen::Vector3d> before = LocateAnchor(anchor, observations, database);
      observation.pixel[axis] = exact + 0.5;
      const Result<Eigen::Vector3d> after = LocateAnchor(anchor, observations, database);
      observation.pixel[axis] = exact;
      variance += before.ok() && after.ok() ? squared_change(*before, *after)
                                            : std::numeric_limits<double>::infinity();
    }
  }
  return variance;
}

// Variance of the anchor's distance from `other`.
double DistanceVariance(const Anchor& anchor,
                        const Eigen::Vector3d& other,
                        const SceneDatabase& database) {
  return Variance(anchor, database, [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const double change = (b - other).norm() - (a - other).norm();
    return change * change;
  });
}

// +Y of the stage, map frame.
Result<Eigen::Vector3d> UpDirection(const Anchor& floor_anchor,
                                    const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& forward,
                                    const Eigen::Vector3d& floor,
                                    const SceneDatabase& database) {
  const Eigen::Vector3d cross = (forward - origin).cross(floor - origin);
  const double size = (forward - origin).norm() * (floor - origin).norm();
  if (!(cross.norm() > std::sin(kMinCorner) * size)) {
    return Problem(floor_anchor, "lies on the line from origin to forward",
                   "pick a point of the floor well to the side of that line");
  }
  const Eigen::Vector3d normal = cross.normalized();
  ptrdiff_t cameras_above = 0;
  for (const Keyframe& keyframe : database.keyframes) {
    cameras_above += normal.dot(keyframe.camera_from_map.Center() - origin) > 0.0 ? 1 : -1;
  }
  return Eigen::Vector3d(cameras_above >= 0 ? normal : -normal);
}

}  // namespace

bool LiesIn(const Pick& pick, const Keyframe& keyframe) {
  return keyframe.session == pick.session && keyframe.frame_index == pick.frame_index &&
         (pick.frame.empty() || pick.frame == keyframe.name);
}

Result<AnchorReport> SolveAnchor(const Anchor& anchor, const SceneDatabase& database) {
  const std::vector<Observation> observations = FindObservations(anchor, database);
  LARARIUM_ASSIGN_OR_RETURN(const Eigen::Vector3d point,
                            LocateAnchor(anchor, observations, database));
  std::vector<Eigen::Vector3d> centers;
  for (const Observation& observation : observations) {
    centers.push_back(database.keyframes[observation.keyframe].camera_from_map.Center());
  }
  const double angle = geometry::WidestAngle(centers, point);
  if (observations.size() > 1 && angle < kMinTriangulationAngle) {
    return Problem(anchor, "the picks see it from almost the same direction",
                   "pick it in keyframes taken farther apart");
  }
  return AnchorReport{anchor.name,
                      static_cast<int>(observations.size()),
                      ReprojectionError(observations, point, database),
                      angle,
                      point,
                      FramesLeftOut(anchor, database)};
}

double AnchorSpread(const Anchor& anchor, const SceneDatabase& database) {
  return std::sqrt(Variance(
      anchor, database,
      [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (b - a).squaredNorm(); }));
}

Result<StageSolution> SolveStage(const StagePicks& picks,
                                 const SceneDatabase& database,
                                 std::optional<double> map_units_per_metre) {
  if (!(picks.length_m > 0.0) || !std::isfinite(picks.length_m)) {
    return Status::Error("stage", "the known length must be more than 0 m", "enter it in metres");
  }
  const Anchor& from = picks.length_from.picks.empty() ? picks.origin : picks.length_from;
  const Anchor& to = picks.length_to.picks.empty() ? picks.forward : picks.length_to;
  LARARIUM_ASSIGN_OR_RETURN(const AnchorReport origin, SolveAnchor(picks.origin, database));
  LARARIUM_ASSIGN_OR_RETURN(const AnchorReport forward, SolveAnchor(picks.forward, database));
  LARARIUM_ASSIGN_OR_RETURN(const AnchorReport floor, SolveAnchor(picks.floor, database));
  LARARIUM_ASSIGN_OR_RETURN(const AnchorReport length_from, SolveAnchor(from, database));
  LARARIUM_ASSIGN_OR_RETURN(const AnchorReport length_to, SolveAnchor(to, database));
  LARARIUM_ASSIGN_OR_RETURN(const Eigen::Vector3d up,
                            UpDirection(picks.floor, origin.point_in_map, forward.point_in_map,
                                        floor.point_in_map, database));
  const double length = (length_to.point_in_map - length_from.point_in_map).norm();
  if (!(length > 0.0)) {
    return Problem(to, "lies at the other end of the known length", "pick two different points");
  }

  StageSolution solution;
  const Eigen::Vector3d back = (origin.point_in_map - forward.point_in_map).normalized();
  Eigen::Matrix3d map_from_stage;
  map_from_stage << up.cross(back), up, back;  // The columns are the images of X, Y and Z.
  const double scale = map_units_per_metre.value_or(length / picks.length_m);
  solution.measured_length_m = length / scale;
  solution.map_from_stage = {scale, Eigen::Quaterniond(map_from_stage).normalized(),
                             origin.point_in_map};
  solution.anchors = {origin, forward, floor};
  if (!picks.length_from.picks.empty()) {
    solution.anchors.push_back(length_from);
  }
  if (!picks.length_to.picks.empty()) {
    solution.anchors.push_back(length_to);
  }
  solution.length_spread = std::sqrt(DistanceVariance(from, length_to.point_in_map, database) +
                                     DistanceVariance(to, length_from.point_in_map, database)) /
                           length;
  return solution;
}

}  // namespace lararium::stage
