#pragma once

// What the tracker's answers on a sequence are worth, against the truth.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "player/benchmark_alignment.h"
#include "player/benchmark_sequence.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

// The tracker's answer to one frame, and what it cost.
struct FrameAnswer {
  const TrueImage* truth = nullptr;  // borrowed; nullptr: the sequence does not name the frame
  double time = 0.0;                 // of its capture, seconds
  std::optional<geometry::Rigid3> camera_from_map;
  uint32_t map = 0;
  bool followed = false;
  double confidence = 0.0;
  // Of (w, v) in the pose (exp(w) R, exp(w) t + v); map units.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::array<double, 3> gain = {1.0, 1.0, 1.0};  // linear R, G, B over the map's reference
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  // of all threads of the program
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

// How far confidences are from the share of frames that deserved them: the
// expected calibration error over ten equal bins (Guo et al., "On calibration of
// modern neural networks", ICML 2017).
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

// After the lens was covered.
struct Recovery {
  size_t first_visible = 0;  // frame
  size_t frames = 0;         // until the pose is back: 1 when that very frame has it
  bool found = false;        // false: none came before the sequence ended or was covered again
};

// A tracked frame whose true pose is known.
struct FrameError {
  size_t frame = 0;
  double registration_px = 0.0;  // mean over the visible points; 0 where there is none
  size_t points = 0;             // visible
  double centre = 0.0;           // world units
  double rotation_deg = 0.0;
  // The squared pose error over its covariance, per degree of freedom: 1 on
  // average where the covariance tells the truth. None without a covariance.
  std::optional<double> normalised_pose_error;
};

struct SequenceScore {
  size_t frames = 0;
  size_t tracked = 0;
  size_t visible = 0;  // frames of which at least kVisible can be seen
  size_t visible_tracked = 0;
  size_t followed = 0;
  size_t longest_loss = 0;  // visible frames in a row without a pose
  // With a pose that is wrong by more than kFalsePixels, that lies in another map
  // than the rest, or, where no true pose is known at all, with any pose.
  size_t false_accepts = 0;
  size_t blind_poses = 0;  // with a pose where nothing can be seen
  std::vector<Recovery> recoveries;

  geometry::Similarity3 world_from_map;
  std::vector<FrameError> errors;
  Summary registration_px;  // over all points of all frames
  Summary centre;
  Summary rotation_deg;
  Calibration calibration;  // correct: registration below kCorrectPixels
  Summary normalised_pose_error;

  // How far the projections stand from their places, frame after frame: the
  // change of the offset between successive tracked frames.
  double swimming_px = 0.0;
  // Of sequences without motion: how far the projections of the map's own points
  // stray from their mean, root mean square over points and frames. Where the
  // camera stands it cannot be seen which scale the map has, so nothing else is
  // compared with the truth.
  std::optional<double> jitter_px;
  // By how much the poses run behind the true motion (negative: ahead).
  std::optional<double> lag_ms;
  // Estimated minus true gain of green in stops, after the median difference is
  // taken away: the map's reference has a gain of its own.
  std::optional<Summary> gain_error_stops;

  Summary followed_wall_ms;
  Summary followed_cpu_ms;
  Summary found_wall_ms;  // found without a prior
  Summary found_cpu_ms;
  Summary missed_wall_ms;  // no pose
  Summary missed_cpu_ms;
};

inline constexpr double kVisible = 0.3;
inline constexpr double kCovered = 0.05;  // visible fraction of a lens that is as good as covered
inline constexpr double kFalsePixels = 10.0;
inline constexpr double kCorrectPixels = 1.0;

// landmarks: for each of the tracker's maps, points all over it.
SequenceScore Evaluate(const BenchmarkSequence& sequence,
                       std::span<const FrameAnswer> answers,
                       std::span<const std::vector<Eigen::Vector3d>> landmarks);

}  // namespace lararium::player
