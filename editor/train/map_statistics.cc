#include "editor/train/map_statistics.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>

namespace lararium::train {
namespace {

using vision::Observation;
using vision::SceneDatabase;

std::optional<double> ErrorPx(const SceneDatabase& db, const Observation& o) {
  const auto pixel = db.camera.Project(db.keyframes[o.keyframe].camera_from_map *
                                       db.points[o.point].cast<double>());
  return pixel ? std::optional((*pixel - Eigen::Vector2d(o.x, o.y)).norm()) : std::nullopt;
}

// An incremental mean.
struct Mean {
  double sum = 0.0;
  uint32_t count = 0;

  void Add(double value) {
    sum += value;
    ++count;
  }
  float Value() const { return count > 0 ? static_cast<float>(sum / count) : -1.0f; }
};

std::vector<float> Values(std::span<const Mean> means) {
  std::vector<float> values;
  values.reserve(means.size());
  for (const Mean& mean : means) {
    values.push_back(mean.Value());
  }
  return values;
}

void GroupObservations(const SceneDatabase& db, MapStatistics& statistics) {
  statistics.first_observation.assign(db.points.size() + 1, 0);
  for (const Observation& o : db.observations) {
    ++statistics.first_observation[o.point + 1];
  }
  for (size_t i = 1; i < statistics.first_observation.size(); ++i) {
    statistics.first_observation[i] += statistics.first_observation[i - 1];
  }
  std::vector<uint32_t> next(statistics.first_observation.begin(),
                             statistics.first_observation.end() - 1);
  statistics.observations.resize(db.observations.size());
  for (uint32_t i = 0; i < db.observations.size(); ++i) {
    statistics.observations[next[db.observations[i].point]++] = i;
  }
}

void MeasureErrors(const SceneDatabase& db, MapStatistics& statistics) {
  std::vector<Mean> of_points(db.points.size());
  std::vector<Mean> of_keyframes(db.keyframes.size());
  double squares = 0.0;
  int64_t freedom = 0;
  statistics.keyframe_points.assign(db.keyframes.size(), 0);
  for (const Observation& o : db.observations) {
    ++statistics.keyframe_points[o.keyframe];
    if (const std::optional<double> error = ErrorPx(db, o)) {
      of_points[o.point].Add(*error);
      of_keyframes[o.keyframe].Add(*error);
      squares += *error * *error;
      freedom += 2;
    }
  }
  for (const Mean& mean : of_points) {
    freedom -= mean.count > 0 ? 3 : 0;
  }
  statistics.point_error_px = Values(of_points);
  statistics.keyframe_error_px = Values(of_keyframes);
  statistics.sigma_px = freedom > 0 ? std::sqrt(squares / static_cast<double>(freedom)) : 0.0;
}

void CountSessions(const SceneDatabase& db, MapStatistics& statistics) {
  for (const vision::Keyframe& keyframe : db.keyframes) {
    ++statistics.session_keyframes[keyframe.session];
  }
  for (const uint32_t mask : db.session_masks) {
    for (size_t session = 0; session < statistics.session_points.size(); ++session) {
      statistics.session_points[session] += mask >> session & 1;
    }
  }
}

std::vector<uint8_t> SingleSessions(std::span<const uint32_t> masks) {
  std::vector<uint8_t> sessions;
  sessions.reserve(masks.size());
  for (const uint32_t mask : masks) {
    sessions.push_back(std::has_single_bit(mask) ? static_cast<uint8_t>(std::countr_zero(mask))
                                                 : kNoSingleSession);
  }
  return sessions;
}

std::vector<uint8_t> PointShades(const SceneDatabase& db) {
  constexpr uint8_t kUnseen = 128;
  std::vector<uint8_t> shades(db.points.size(), kUnseen);
  std::vector<bool> seen(db.points.size(), false);
  for (const Observation& o : db.observations) {
    const cv::Mat& grey = db.keyframes[o.keyframe].grey;
    const int x = static_cast<int>(std::lround(o.x));
    const int y = static_cast<int>(std::lround(o.y));
    if (!seen[o.point] && x >= 0 && y >= 0 && x < grey.cols && y < grey.rows) {
      seen[o.point] = true;
      shades[o.point] = grey.at<uint8_t>(y, x);
    }
  }
  return shades;
}

// Derivative of the pixel by the point in map units, by central differences.
std::optional<Eigen::Matrix<double, 2, 3>> PixelJacobian(const SceneDatabase& db,
                                                         const Observation& o) {
  const Eigen::Vector3d in_camera =
      db.keyframes[o.keyframe].camera_from_map * db.points[o.point].cast<double>();
  const double step = 1e-6 * std::abs(in_camera.z());
  Eigen::Matrix<double, 2, 3> in_axes;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(axis);
    const auto before = db.camera.Project(in_camera - offset);
    const auto after = db.camera.Project(in_camera + offset);
    if (!before || !after || !(step > 0.0)) {
      return std::nullopt;
    }
    in_axes.col(axis) = (*after - *before) / (2.0 * step);
  }
  return in_axes * db.keyframes[o.keyframe].camera_from_map.rotation.toRotationMatrix();
}

}  // namespace

MapStatistics MeasureStatistics(const SceneDatabase& database) {
  MapStatistics statistics;
  GroupObservations(database, statistics);
  MeasureErrors(database, statistics);
  CountSessions(database, statistics);
  statistics.point_session = SingleSessions(database.session_masks);
  statistics.point_shades = PointShades(database);
  return statistics;
}

double ErrorQuantilePx(const SceneDatabase& database, double share) {
  std::vector<double> errors;
  errors.reserve(database.observations.size());
  for (const Observation& o : database.observations) {
    if (const std::optional<double> error = ErrorPx(database, o)) {
      errors.push_back(*error);
    }
  }
  if (errors.empty()) {
    return 0.0;
  }
  const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(errors.size())));
  const size_t index = std::clamp<size_t>(rank, 1, errors.size()) - 1;
  std::nth_element(errors.begin(), errors.begin() + static_cast<ptrdiff_t>(index), errors.end());
  return errors[index];
}

void AddUnobserved(uint32_t session, MapStatistics& statistics) {
  ++statistics.session_keyframes[session];
  statistics.keyframe_points.push_back(0);
  statistics.keyframe_error_px.push_back(Mean().Value());
}

std::optional<Eigen::Matrix3d> PointCovariance(const SceneDatabase& database,
                                               const MapStatistics& statistics,
                                               uint32_t point) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const uint32_t observation : statistics.ObservationsOf(point)) {
    if (const auto jacobian = PixelJacobian(database, database.observations[observation])) {
      information += jacobian->transpose() * *jacobian;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(information);
  // Minimum ratio of the smallest to the largest eigenvalue. A single observation stays below it.
  constexpr double kLeast = 1e-9;
  if (!(solver.eigenvalues()(0) > kLeast * solver.eigenvalues()(2))) {
    return std::nullopt;
  }
  const Eigen::Matrix3d& axes = solver.eigenvectors();
  return Eigen::Matrix3d(statistics.sigma_px * statistics.sigma_px * axes *
                         solver.eigenvalues().cwiseInverse().asDiagonal() * axes.transpose());
}

std::optional<double> DistanceDeviation(const SceneDatabase& database,
                                        const MapStatistics& statistics,
                                        uint32_t from,
                                        uint32_t to) {
  const auto of_from = PointCovariance(database, statistics, from);
  const auto of_to = PointCovariance(database, statistics, to);
  const Eigen::Vector3d apart = (database.points[to] - database.points[from]).cast<double>();
  if (!of_from || !of_to || !(apart.norm() > 0.0)) {
    return std::nullopt;
  }
  const Eigen::Vector3d along = apart.normalized();
  return std::sqrt(along.dot((*of_from + *of_to) * along));
}

}  // namespace lararium::train
