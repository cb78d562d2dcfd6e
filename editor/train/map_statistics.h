#pragma once

// What a map says of its own points and keyframes: how often and by whom they were seen, and
// how well their sights agree.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/vision/scene_database.h"

namespace lararium::train {

// Several sessions, or none, saw a point.
inline constexpr uint8_t kNoSingleSession = 0xff;

// Borrows nothing of the database. Parallel arrays over its points and keyframes.
struct MapStatistics {
  // Mean distance between where a point was seen and where it projects, over its observations;
  // raw pixels. Negative where none can be judged.
  std::vector<float> point_error_px;
  std::vector<uint8_t> point_session;  // the only one that saw it, or kNoSingleSession
  std::vector<uint8_t> point_shades;   // the grey of its first sight in an image
  // [points + 1] and the indices of observations that they range over.
  std::vector<uint32_t> sight_begin;
  std::vector<uint32_t> sights;

  // Of each session: its keyframes, and the points that it saw.
  std::array<uint32_t, 32> session_keyframes = {};
  std::array<uint32_t, 32> session_points = {};

  std::vector<uint32_t> keyframe_points;  // that it observes
  std::vector<float> keyframe_error_px;   // mean over these; negative: none

  // Standard deviation of one coordinate of one observation, estimated from all residuals:
  // each point took three degrees of freedom. Pixels; 0 where nothing is left to judge by.
  double sigma_px = 0.0;

  std::span<const uint32_t> SightsOf(uint32_t point) const {
    return std::span(sights).subspan(sight_begin[point],
                                     sight_begin[point + 1] - sight_begin[point]);
  }
  // Observations that the map holds of it.
  uint32_t ViewsOf(uint32_t point) const { return sight_begin[point + 1] - sight_begin[point]; }
};

// Of a valid database. A tenth of a second for a hundred thousand points.
MapStatistics MeasureStatistics(const vision::SceneDatabase& database);

// The reprojection error, in raw pixels, that this share of the observations, 0 to 1, does not
// exceed; 0 where none can be judged.
double ErrorQuantilePx(const vision::SceneDatabase& database, double share);

// What they are of the same database with one keyframe more, which observes no points, of a session
// that it has.
void AddUnobserved(uint32_t session, MapStatistics& statistics);

// Covariance of a point's position, squared map units: to first order, from the angles at which
// its observations see it, each coordinate off by sigma_px, poses taken as exact (Hartley &
// Zisserman, Multiple View Geometry, 5.2). nullopt where they do not determine the point.
std::optional<Eigen::Matrix3d> PointCovariance(const vision::SceneDatabase& database,
                                               const MapStatistics& statistics,
                                               uint32_t point);

// Standard deviation of the distance between two points, map units, likewise. Errors of the
// poses, which the points have in common, are not in it. nullopt where either is not determined.
std::optional<double> DistanceDeviation(const vision::SceneDatabase& database,
                                        const MapStatistics& statistics,
                                        uint32_t from,
                                        uint32_t to);

}  // namespace lararium::train
