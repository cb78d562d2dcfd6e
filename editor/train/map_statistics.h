#pragma once

// Statistics of a map's points and keyframes: how often and in which session they were observed,
// and how well their observations agree.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/vision/scene_database.h"

namespace lararium::train {

// Marks a point that was observed in several sessions, or in none.
inline constexpr uint8_t kNoSingleSession = 0xff;

// Independent of the database's lifetime. Parallel arrays over its points and keyframes.
struct MapStatistics {
  // Mean reprojection error over a point's observations, raw pixels. Negative if there is none.
  std::vector<float> point_error_px;
  std::vector<uint8_t> point_session;  // The only session that observed it, or kNoSingleSession.
  std::vector<uint8_t> point_shades;   // Grey level at its first observation in an image.
  // [points + 1]: Ranges of `observations`, which holds indices of SceneDatabase::observations.
  std::vector<uint32_t> first_observation;
  std::vector<uint32_t> observations;

  // Number of keyframes and of observed points per session.
  std::array<uint32_t, 32> session_keyframes = {};
  std::array<uint32_t, 32> session_points = {};

  std::vector<uint32_t> keyframe_points;  // Number of points that the keyframe observes.
  std::vector<float> keyframe_error_px;   // Mean reprojection error; negative without points.

  // Standard deviation of one coordinate of one observation, pixels. Estimated from all residuals,
  // of which each point used three degrees of freedom; 0 if none are left.
  double sigma_px = 0.0;

  std::span<const uint32_t> ObservationsOf(uint32_t point) const {
    return std::span(observations)
        .subspan(first_observation[point], first_observation[point + 1] - first_observation[point]);
  }
  // Number of observations of the point in the map.
  uint32_t ViewsOf(uint32_t point) const {
    return first_observation[point + 1] - first_observation[point];
  }
};

// Measures a valid database. Takes about 0.1 s for a hundred thousand points.
MapStatistics MeasureStatistics(const vision::SceneDatabase& database);

// The reprojection error, in raw pixels, that the given share (0 to 1) of the observations does not
// exceed; 0 if no observation can be projected.
double ErrorQuantilePx(const vision::SceneDatabase& database, double share);

// Updates the statistics for one more keyframe of an existing session that observes no points.
void AddUnobserved(uint32_t session, MapStatistics& statistics);

// Covariance of a point's position, squared map units: first-order propagation of sigma_px per
// observed coordinate, with poses taken as exact (Hartley & Zisserman, "Multiple View Geometry",
// section 5.2). nullopt if the observations do not determine the point.
std::optional<Eigen::Matrix3d> PointCovariance(const vision::SceneDatabase& database,
                                               const MapStatistics& statistics,
                                               uint32_t point);

// Standard deviation of the distance between two points, map units, from their PointCovariance.
// Does not include errors of the poses, which affect both points. nullopt if either point is not
// determined.
std::optional<double> DistanceDeviation(const vision::SceneDatabase& database,
                                        const MapStatistics& statistics,
                                        uint32_t from,
                                        uint32_t to);

}  // namespace lararium::train
