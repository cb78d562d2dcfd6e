#include "player/benchmark/benchmark_evaluation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "shared/core/units.h"

namespace lararium::player {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Rigid3;
using geometry::Similarity3;

double VisibleFraction(const FrameAnswer& answer) {
  return answer.truth == nullptr ? 1.0 : answer.truth->visible_fraction;
}

bool HasTruth(const FrameAnswer& answer) {
  return answer.truth != nullptr && answer.truth->camera_from_world.has_value();
}

// The map that contains most poses.
uint32_t MainMap(std::span<const FrameAnswer> answers) {
  std::map<uint32_t, size_t> counts;
  for (const FrameAnswer& answer : answers) {
    counts[answer.map] += answer.camera_from_map.has_value();
  }
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](auto& a, auto& b) { return a.second < b.second; });
  return most == counts.end() ? 0 : most->first;
}

// ------------------------------------------------------------ counting

void CountFrames(std::span<const FrameAnswer> answers, SequenceScore& score) {
  score.frames = answers.size();
  size_t loss = 0;
  for (const FrameAnswer& answer : answers) {
    const bool tracked = answer.camera_from_map.has_value();
    const bool visible = VisibleFraction(answer) >= kVisible;
    score.tracked += tracked;
    score.visible += visible;
    score.visible_tracked += visible && tracked;
    score.followed += tracked && answer.followed;
    score.blind_poses += tracked && VisibleFraction(answer) <= 0.0;
    loss = visible && !tracked ? loss + 1 : 0;
    score.longest_loss = std::max(score.longest_loss, loss);
  }
}

// wrong: parallel to answers; poses of these answers are ignored.
std::vector<Recovery> FindRecoveries(std::span<const FrameAnswer> answers,
                                     const std::vector<bool>& wrong) {
  std::vector<Recovery> recoveries;
  bool covered = false;
  bool waiting = false;
  for (size_t i = 0; i < answers.size(); ++i) {
    const double visible = VisibleFraction(answers[i]);
    if (visible < kCovered) {
      covered = true;
      waiting = false;
    } else if (covered && visible >= kVisible) {
      covered = false;
      waiting = true;
      recoveries.push_back({i, 0, false});
    }
    if (waiting) {
      Recovery& recovery = recoveries.back();
      ++recovery.frames;
      recovery.found = answers[i].camera_from_map.has_value() && !wrong[i];
      waiting = !recovery.found;
    }
  }
  return recoveries;
}

// ------------------------------------------------------------ errors of poses

std::optional<double> NormalisedPoseError(const FrameAnswer& answer,
                                          const Similarity3& world_from_map) {
  // The motion from the estimate to the truth, in the frame of the map.
  const Rigid3 truth = geometry::CameraFromB(*answer.truth->camera_from_world, world_from_map);
  const Eigen::Quaterniond turn = truth.rotation * answer.camera_from_map->rotation.conjugate();
  Eigen::Matrix<double, 6, 1> error;
  error << geometry::VectorFromRotation(turn),
      truth.translation - turn * answer.camera_from_map->translation;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> covariance(answer.covariance);
  if (covariance.info() != Eigen::Success || !(covariance.vectorD().minCoeff() > 0.0)) {
    return std::nullopt;
  }
  return error.dot(covariance.solve(error)) / 6.0;
}

// Offsets between estimated and true projections of the visible points of a frame.
struct FrameOffsets {
  size_t frame = 0;
  Rigid3 estimate;  // camera_from_world
};

// camera_from_point: the pose in the frame that the point is in.
Vector2d Project(const TrueImage& image, const Rigid3& camera_from_point, const Vector3d& point) {
  const std::optional<Vector2d> pixel = image.camera.Project(camera_from_point * point);
  return pixel.value_or(Vector2d::Constant(std::hypot(image.camera.width, image.camera.height)));
}

// Measures how the offsets of points that are visible in both of two successive frames change.
double Swimming(const BenchmarkSequence& sequence,
                std::span<const FrameAnswer> answers,
                std::span<const FrameOffsets> frames) {
  double sum = 0.0;
  size_t count = 0;
  for (size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].frame != frames[i - 1].frame + 1) {
      continue;
    }
    const TrueImage& before = *answers[frames[i - 1].frame].truth;
    const TrueImage& now = *answers[frames[i].frame].truth;
    for (const VisiblePoint& point :
         VisiblePoints(sequence.points, now.camera, *now.camera_from_world)) {
      const std::optional<Vector2d> was =
          before.camera.Project(*before.camera_from_world * point.in_world);
      if (!was || !before.camera.Contains(*was)) {
        continue;
      }
      const Vector2d offset_before = Project(before, frames[i - 1].estimate, point.in_world) - *was;
      const Vector2d offset_now = Project(now, frames[i].estimate, point.in_world) - point.pixel;
      sum += (offset_now - offset_before).norm();
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

// Solves offset = -lag * velocity by least squares over points and frames. The velocity is the
// central difference of the true pixels.
std::optional<double> LagMilliseconds(const BenchmarkSequence& sequence,
                                      std::span<const FrameAnswer> answers,
                                      std::span<const FrameOffsets> frames) {
  double along = 0.0;
  double square = 0.0;
  for (const FrameOffsets& at : frames) {
    const bool inner = at.frame > 0 && at.frame + 1 < answers.size();
    if (!inner || !HasTruth(answers[at.frame - 1]) || !HasTruth(answers[at.frame + 1])) {
      continue;
    }
    const FrameAnswer& before = answers[at.frame - 1];
    const FrameAnswer& after = answers[at.frame + 1];
    const TrueImage& now = *answers[at.frame].truth;
    const double span = after.time - before.time;
    if (!(span > 0.0)) {
      continue;
    }
    for (const VisiblePoint& point :
         VisiblePoints(sequence.points, now.camera, *now.camera_from_world)) {
      const auto was =
          before.truth->camera.Project(*before.truth->camera_from_world * point.in_world);
      const auto will =
          after.truth->camera.Project(*after.truth->camera_from_world * point.in_world);
      if (was && will) {
        const Vector2d velocity = (*will - *was) / span;
        along += velocity.dot(Project(now, at.estimate, point.in_world) - point.pixel);
        square += velocity.squaredNorm();
      }
    }
  }
  return square > 0.0 ? std::optional(-1e3 * along / square) : std::nullopt;
}

double Jitter(const BenchmarkSequence& sequence,
              std::span<const FrameAnswer> answers,
              std::span<const size_t> frames,
              std::span<const Vector3d> landmarks) {
  const TrueImage& image = sequence.images.front();
  double sum = 0.0;
  size_t count = 0;
  for (const VisiblePoint& point :
       VisiblePoints(landmarks, image.camera, *answers[frames.front()].camera_from_map)) {
    Vector2d mean = Vector2d::Zero();
    for (const size_t i : frames) {
      mean += Project(image, *answers[i].camera_from_map, point.in_world) /
              static_cast<double>(frames.size());
    }
    for (const size_t i : frames) {
      sum += (Project(image, *answers[i].camera_from_map, point.in_world) - mean).squaredNorm();
      ++count;
    }
  }
  return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

// ------------------------------------------------------------ gain and time

std::optional<Summary> GainErrors(std::span<const FrameAnswer> answers) {
  std::vector<double> differences;
  for (const FrameAnswer& answer : answers) {
    if (answer.camera_from_map && answer.truth != nullptr && answer.truth->gain_ev &&
        answer.gain[1] > 0.0) {
      differences.push_back(std::log2(answer.gain[1]) - *answer.truth->gain_ev);
    }
  }
  if (differences.empty()) {
    return std::nullopt;
  }
  const double median = Summarise(differences).median;
  for (double& difference : differences) {
    difference = std::abs(difference - median);
  }
  return Summarise(std::move(differences));
}

void TimeFrames(std::span<const FrameAnswer> answers, SequenceScore& score) {
  std::vector<double> wall[3];
  std::vector<double> cpu[3];
  for (const FrameAnswer& answer : answers) {
    const int kind = !answer.camera_from_map ? 2 : answer.followed ? 0 : 1;
    wall[kind].push_back(answer.wall_ms);
    cpu[kind].push_back(answer.cpu_ms);
  }
  score.followed_wall_ms = Summarise(std::move(wall[0]));
  score.followed_cpu_ms = Summarise(std::move(cpu[0]));
  score.found_wall_ms = Summarise(std::move(wall[1]));
  score.found_cpu_ms = Summarise(std::move(cpu[1]));
  score.missed_wall_ms = Summarise(std::move(wall[2]));
  score.missed_cpu_ms = Summarise(std::move(cpu[2]));
}

// The frames that can be compared: tracked in the main map, with a true pose.
std::vector<size_t> Comparable(std::span<const FrameAnswer> answers, uint32_t map) {
  std::vector<size_t> frames;
  for (size_t i = 0; i < answers.size(); ++i) {
    if (answers[i].camera_from_map && answers[i].map == map && HasTruth(answers[i])) {
      frames.push_back(i);
    }
  }
  return frames;
}

FrameError CompareFrame(size_t frame,
                        const FrameAnswer& answer,
                        const Similarity3& world_from_map,
                        std::span<const double> registration) {
  const Rigid3 estimate = CameraFromWorld(*answer.camera_from_map, world_from_map);
  const Rigid3& truth = *answer.truth->camera_from_world;
  FrameError error;
  error.frame = frame;
  error.points = registration.size();
  for (const double px : registration) {
    error.registration_px += px / static_cast<double>(registration.size());
  }
  error.centre = (estimate.Center() - truth.Center()).norm();
  error.rotation_deg = kDegreesPerRadian * estimate.rotation.angularDistance(truth.rotation);
  error.normalised_pose_error = NormalisedPoseError(answer, world_from_map);
  return error;
}

// Computes the errors of each comparable frame, and their distributions.
std::vector<FrameOffsets> ComparePoses(const BenchmarkSequence& sequence,
                                       std::span<const FrameAnswer> answers,
                                       std::span<const size_t> frames,
                                       SequenceScore& score) {
  std::vector<PosePair> pairs;
  for (const size_t i : frames) {
    pairs.push_back({answers[i].truth->camera, *answers[i].truth->camera_from_world,
                     *answers[i].camera_from_map});
  }
  const std::optional<Alignment> alignment = AlignOnPoints(pairs, sequence.points);
  score.world_from_map = alignment->world_from_map;
  std::vector<FrameOffsets> offsets;
  std::vector<double> pixels;
  std::vector<double> centres;
  std::vector<double> rotations;
  std::vector<double> normalised;
  for (size_t k = 0; k < frames.size(); ++k) {
    const Rigid3 estimate = CameraFromWorld(pairs[k].camera_from_map, score.world_from_map);
    const std::vector<double> registration = RegistrationErrors(
        VisiblePoints(sequence.points, pairs[k].camera, pairs[k].camera_from_world),
        pairs[k].camera, estimate);
    const FrameError& error = score.errors.emplace_back(
        CompareFrame(frames[k], answers[frames[k]], score.world_from_map, registration));
    offsets.push_back({frames[k], estimate});
    pixels.insert(pixels.end(), registration.begin(), registration.end());
    rotations.push_back(error.rotation_deg);
    centres.push_back(error.centre);
    if (error.normalised_pose_error) {
      normalised.push_back(*error.normalised_pose_error);
    }
    if (error.points > 0) {
      score.calibration.Add(answers[frames[k]].confidence, error.registration_px < kCorrectPixels);
    }
  }
  score.registration_px = Summarise(std::move(pixels));
  score.centre = Summarise(std::move(centres));
  score.rotation_deg = Summarise(std::move(rotations));
  score.normalised_pose_error = Summarise(std::move(normalised));
  return offsets;
}

}  // namespace

Summary Summarise(std::vector<double> values) {
  Summary summary;
  summary.count = values.size();
  if (values.empty()) {
    return summary;
  }
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double q) {
    const double at = q * static_cast<double>(values.size() - 1);
    const auto below = static_cast<size_t>(at);
    const size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
  };
  for (const double value : values) {
    summary.mean += value / static_cast<double>(values.size());
  }
  summary.median = quantile(0.5);
  summary.p95 = quantile(0.95);
  summary.max = values.back();
  return summary;
}

void Calibration::Add(double confidence, bool correct) {
  const double scaled = std::clamp(confidence, 0.0, 1.0) * static_cast<double>(kBins);
  Bin& bin = bins_[std::min(static_cast<size_t>(scaled), kBins - 1)];
  ++bin.count;
  bin.correct += correct;
  bin.confidence += confidence;
}

void Calibration::Add(const Calibration& other) {
  for (size_t i = 0; i < kBins; ++i) {
    bins_[i].count += other.bins_[i].count;
    bins_[i].correct += other.bins_[i].correct;
    bins_[i].confidence += other.bins_[i].confidence;
  }
}

size_t Calibration::count() const {
  size_t count = 0;
  for (const Bin& bin : bins_) {
    count += bin.count;
  }
  return count;
}

double Calibration::Error() const {
  double gap = 0.0;
  for (const Bin& bin : bins_) {
    gap += std::abs(bin.confidence - static_cast<double>(bin.correct));
  }
  return count() == 0 ? 0.0 : gap / static_cast<double>(count());
}

SequenceScore Evaluate(const BenchmarkSequence& sequence,
                       std::span<const FrameAnswer> answers,
                       std::span<const std::vector<Vector3d>> landmarks) {
  SequenceScore score;
  CountFrames(answers, score);
  TimeFrames(answers, score);
  score.gain_error_stops = GainErrors(answers);
  std::vector<bool> wrong(answers.size(), false);
  const uint32_t map = MainMap(answers);
  const bool known = sequence.HasPoses();
  for (size_t i = 0; i < answers.size(); ++i) {
    wrong[i] = answers[i].camera_from_map && (answers[i].map != map || !known);
  }
  const std::vector<size_t> frames = Comparable(answers, map);
  if (sequence.IsStill()) {
    if (!frames.empty() && map < landmarks.size()) {
      score.jitter_px = Jitter(sequence, answers, frames, landmarks[map]);
    }
  } else if (!frames.empty()) {
    const std::vector<FrameOffsets> offsets = ComparePoses(sequence, answers, frames, score);
    for (const FrameError& error : score.errors) {
      wrong[error.frame] = error.registration_px > kFalsePixels;
    }
    score.swimming_px = Swimming(sequence, answers, offsets);
    score.lag_ms = LagMilliseconds(sequence, answers, offsets);
  }
  score.false_accepts = static_cast<size_t>(std::count(wrong.begin(), wrong.end(), true));
  score.recoveries = FindRecoveries(answers, wrong);
  return score;
}

}  // namespace lararium::player
