#pragma once

// Compares the tracker's results on a sequence with the ground truth.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "player/benchmark/benchmark_alignment.h"
#include "player/benchmark/benchmark_sequence.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

// The tracker's result for one frame, and the time that it took.
struct FrameAnswer {
  const TrueImage* truth = nullptr;  // borrowed; nullptr: the frame has no ground truth
  double time = 0.0;                 // capture time, seconds
  std::optional<geometry::Rigid3> camera_from_map;
  uint32_t map = 0;
  bool followed = false;
  double confidence = 0.0;
  // Covariance of (w, v) in the pose (exp(w) R, exp(w) t + v); map units.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::array<double, 3> gain = {1.0, 1.0, 1.0};  // linear R, G, B divided by the map's reference
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  // sum over all threads of the program
};

// The distribution of a figure. Quantiles interpolate linearly between samples.
struct Summary {
  size_t count = 0;
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};
Summary Summarise(std::vector<double> values);

// Difference between confidences and the share of correct frames: the expected calibration error
// over ten equal bins (Guo et al., "On calibration of modern neural networks", ICML 2017).
class Calibration {
 public:
  static constexpr size_t kBins = 10;

  void Add(double confidence, bool correct);
  void Add(const Calibration& other);
  size_t count() const;
  double Error() const;  // 0 when empty

 private:
  struct Bin {
    size_t count = 0;
    size_t correct = 0;
    double confidence = 0.0;  // sum
  };
  std::array<Bin, kBins> bins_;
};

// Time until a pose is found after the lens was covered.
struct Recovery {
  size_t first_visible = 0;  // index of the first visible frame
  size_t frames = 0;         // frames until there is a pose; 1: first_visible has one
  bool found = false;        // false: no pose before the sequence ended or was covered again
};

// A tracked frame whose true pose is known.
struct FrameError {
  size_t frame = 0;
  double registration_px = 0.0;  // mean over visible points; 0 if there are none
  size_t points = 0;             // number of visible points
  double centre = 0.0;           // world units
  double rotation_deg = 0.0;
  // Squared pose error normalised by its covariance, per degree of freedom: 1 on average if the
  // covariance is right. nullopt: there is no covariance.
  std::optional<double> normalised_pose_error;
};

struct SequenceScore {
  size_t frames = 0;
  size_t tracked = 0;
  size_t visible = 0;  // frames with a visible fraction of at least kVisible
  size_t visible_tracked = 0;
  size_t followed = 0;
  size_t longest_loss = 0;  // visible frames in a row without a pose
  // Frames whose pose is wrong by more than kFalsePixels or lies in another map than the others.
  // If the sequence has no true poses at all, all frames with a pose.
  size_t false_accepts = 0;
  size_t blind_poses = 0;  // frames with a pose although their visible fraction is 0
  std::vector<Recovery> recoveries;

  geometry::Similarity3 world_from_map;
  std::vector<FrameError> errors;
  Summary registration_px;  // all points of all frames
  Summary centre;
  Summary rotation_deg;
  Calibration calibration;  // a frame is correct if registration_px is below kCorrectPixels
  Summary normalised_pose_error;

  // Change of the offset between estimated and true projections from one tracked frame to the next.
  double swimming_px = 0.0;
  // For sequences without motion: RMS deviation of the projections of the map's own points from
  // their mean, over points and frames. The scale of the map cannot be observed without motion, so
  // nothing else is compared with the truth.
  std::optional<double> jitter_px;
  // Delay of the poses behind the true motion (negative: ahead).
  std::optional<double> lag_ms;
  // Estimated minus true gain of green in stops. The median difference is subtracted, because the
  // map's reference has a gain of its own.
  std::optional<Summary> gain_error_stops;

  Summary followed_wall_ms;
  Summary followed_cpu_ms;
  Summary found_wall_ms;  // frames relocalised without a prior
  Summary found_cpu_ms;
  Summary missed_wall_ms;  // frames without a pose
  Summary missed_cpu_ms;
};

inline constexpr double kVisible = 0.3;
inline constexpr double kCovered = 0.05;  // below this visible fraction the lens counts as covered
inline constexpr double kFalsePixels = 10.0;
inline constexpr double kCorrectPixels = 1.0;

// landmarks: for each of the tracker's maps, a sample of its points.
SequenceScore Evaluate(const BenchmarkSequence& sequence,
                       std::span<const FrameAnswer> answers,
                       std::span<const std::vector<Eigen::Vector3d>> landmarks);

}  // namespace lararium::player
