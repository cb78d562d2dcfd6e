#include "editor/train/photometric_reference.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "shared/core/check.h"
#include "shared/core/parallel.h"

namespace lararium::train {
namespace {

constexpr int kIterations = 12;
// Scale of the loss: an observation with a residual of this many robust deviations gets half
// weight.
constexpr double kLossDeviations = 2.0;
constexpr double kLeastDeviation = 0.01;  // Deviation by quantisation alone.
// Minimum sum of a point's weights for a usable colour.
constexpr double kLeastWeight = 0.3;
// Weight of the prior that pulls undetermined gains towards 1, in units of one observation's
// weight.
constexpr double kPriorWeight = 1e-3;

// One channel of one observation.
struct LogObservation {
  uint32_t point;
  uint32_t keyframe;
  double log;     // Logarithm of the linear value.
  double weight;  // Weight of the sample; see LinearColour.
  double robust;  // `weight` times the weight by the loss in this iteration.
};

// Solves the least squares of one channel.
class ChannelSolver {
 public:
  ChannelSolver(std::span<const ColourObservation> observations,
                size_t keyframe_count,
                std::span<const Eigen::Vector3f> known,
                int channel)
      : log_gains_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(keyframe_count))),
        log_colours_(known.size(), 0.0),
        known_(known.size(), false) {
    for (size_t point = 0; point < known.size(); ++point) {
      known_[point] = known[point][channel] > 0.0f;
      if (known_[point]) {
        log_colours_[point] = std::log(static_cast<double>(known[point][channel]));
        any_known_ = true;
      }
    }
    for (const ColourObservation& observation : observations) {
      const double weight = observation.colour.weight[channel];
      if (weight > 0.0) {
        observations_.push_back({observation.point, observation.keyframe,
                                 std::log(static_cast<double>(observation.colour.rgb[channel])),
                                 weight, weight});
      }
    }
    std::stable_sort(
        observations_.begin(), observations_.end(),
        [](const LogObservation& a, const LogObservation& b) { return a.point < b.point; });
  }

  void Solve() {
    for (int i = 0; i < kIterations && !observations_.empty(); ++i) {
      SolveGains();
      SolveColours();
      Reweigh();
    }
    if (!any_known_) {
      FixGauge();
    }
  }

  double Gain(size_t keyframe) const {
    return std::exp(log_gains_[static_cast<Eigen::Index>(keyframe)]);
  }

  // [points]: The colours; negative if the observations do not determine one.
  std::vector<float> Colours() const {
    std::vector<float> colours(log_colours_.size(), -1.0f);
    ForEachPoint([&](size_t point, std::span<const LogObservation> observations) {
      double weight = 0.0;
      for (const LogObservation& observation : observations) {
        weight += observation.robust;
      }
      if (weight >= kLeastWeight) {
        colours[point] = static_cast<float>(std::exp(log_colours_[point]));
      }
    });
    return colours;
  }

 private:
  template <typename Visit>
  void ForEachPoint(Visit visit) const {
    for (size_t begin = 0; begin < observations_.size();) {
      size_t end = begin;
      while (end < observations_.size() && observations_[end].point == observations_[begin].point) {
        ++end;
      }
      visit(observations_[begin].point, std::span(observations_).subspan(begin, end - begin));
      begin = end;
    }
  }

  static double MeanLog(std::span<const LogObservation> observations) {
    double sum = 0.0;
    double weight = 0.0;
    for (const LogObservation& observation : observations) {
      sum += observation.robust * observation.log;
      weight += observation.robust;
    }
    return sum / weight;
  }

  void SolveGains() {
    const Eigen::Index count = log_gains_.size();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(count, count) * kPriorWeight;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    ForEachPoint([&](size_t point, std::span<const LogObservation> observations) {
      const double mean = known_[point] ? log_colours_[point] : MeanLog(observations);
      double total = 0.0;
      for (const LogObservation& observation : observations) {
        normal(observation.keyframe, observation.keyframe) += observation.robust;
        right[observation.keyframe] += observation.robust * (observation.log - mean);
        total += observation.robust;
      }
      if (known_[point]) {
        return;
      }
      for (const LogObservation& a : observations) {
        for (const LogObservation& b : observations) {
          normal(a.keyframe, b.keyframe) -= a.robust * b.robust / total;
        }
      }
    });
    log_gains_ = normal.ldlt().solve(right);
  }

  void SolveColours() {
    ForEachPoint([&](size_t point, std::span<const LogObservation> observations) {
      if (known_[point]) {
        return;
      }
      double sum = 0.0;
      double weight = 0.0;
      for (const LogObservation& observation : observations) {
        sum += observation.robust * (observation.log - log_gains_[observation.keyframe]);
        weight += observation.robust;
      }
      log_colours_[point] = sum / weight;
    });
  }

  double Residual(const LogObservation& observation) const {
    return observation.log - log_gains_[observation.keyframe] - log_colours_[observation.point];
  }

  void Reweigh() {
    std::vector<double> sizes;
    sizes.reserve(observations_.size());
    for (const LogObservation& observation : observations_) {
      sizes.push_back(std::abs(Residual(observation)));
    }
    const auto middle = sizes.begin() + static_cast<ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    // Standard deviation over median absolute residual of a normal distribution.
    constexpr double kDeviationOfMedian = 1.4826;
    const double scale = kLossDeviations * std::max(kDeviationOfMedian * *middle, kLeastDeviation);
    for (LogObservation& observation : observations_) {
      const double r = Residual(observation) / scale;
      observation.robust = observation.weight / (1.0 + r * r);
    }
  }

  void FixGauge() {
    std::vector<bool> seen(static_cast<size_t>(log_gains_.size()), false);
    for (const LogObservation& observation : observations_) {
      seen[observation.keyframe] = true;
    }
    std::vector<double> logs;
    for (size_t keyframe = 0; keyframe < seen.size(); ++keyframe) {
      if (seen[keyframe]) {
        logs.push_back(log_gains_[static_cast<Eigen::Index>(keyframe)]);
      }
    }
    if (logs.empty()) {
      return;
    }
    const auto middle = logs.begin() + static_cast<ptrdiff_t>(logs.size() / 2);
    std::nth_element(logs.begin(), middle, logs.end());
    const double shift = *middle;
    for (size_t keyframe = 0; keyframe < seen.size(); ++keyframe) {
      if (seen[keyframe]) {
        log_gains_[static_cast<Eigen::Index>(keyframe)] -= shift;
      }
    }
    for (double& colour : log_colours_) {
      colour += shift;
    }
  }

  std::vector<LogObservation> observations_;  // Sorted by point.
  Eigen::VectorXd log_gains_;
  std::vector<double> log_colours_;
  std::vector<bool> known_;  // [points]: Whether the colour is fixed.
  bool any_known_ = false;
};

std::vector<ColourObservation> SampleObservations(const vision::SceneDatabase& database,
                                                  std::span<const cv::Mat> bgr) {
  const std::vector<vision::Observation>& observations = database.observations;
  std::vector<std::optional<vision::LinearColour>> samples(observations.size());
  ParallelFor(bgr.size(), [&](size_t keyframe) {
    if (bgr[keyframe].empty()) {
      return;
    }
    const auto first = std::lower_bound(
        observations.begin(), observations.end(), keyframe,
        [](const vision::Observation& o, size_t wanted) { return o.keyframe < wanted; });
    for (auto o = first; o != observations.end() && o->keyframe == keyframe; ++o) {
      samples[static_cast<size_t>(o - observations.begin())] =
          vision::SampleLinear(bgr[keyframe], o->x, o->y);
    }
  });
  std::vector<ColourObservation> coloured;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (samples[i]) {
      coloured.push_back({observations[i].point, observations[i].keyframe, *samples[i]});
    }
  }
  return coloured;
}

}  // namespace

PhotometricReference SolvePhotometry(std::span<const ColourObservation> observations,
                                     size_t keyframe_count,
                                     std::span<const Eigen::Vector3f> known) {
  for (const ColourObservation& observation : observations) {
    CHECK(observation.point < known.size() && observation.keyframe < keyframe_count);
  }
  PhotometricReference reference;
  reference.colours.assign(known.begin(), known.end());
  reference.gains.resize(keyframe_count);
  ParallelFor(3, [&](size_t channel) {
    ChannelSolver solver(observations, keyframe_count, known, static_cast<int>(channel));
    solver.Solve();
    const std::vector<float> colours = solver.Colours();
    for (size_t point = 0; point < known.size(); ++point) {
      float& colour = reference.colours[point][static_cast<Eigen::Index>(channel)];
      colour = colour > 0.0f ? colour : colours[point];
    }
    for (size_t keyframe = 0; keyframe < keyframe_count; ++keyframe) {
      reference.gains[keyframe][channel] = static_cast<float>(solver.Gain(keyframe));
    }
  });
  return reference;
}

void FillPhotometry(vision::SceneDatabase& database, std::span<const cv::Mat> bgr) {
  CHECK(bgr.size() == database.keyframes.size());
  const std::vector<ColourObservation> observations = SampleObservations(database, bgr);
  if (observations.empty()) {
    return;
  }
  std::vector<Eigen::Vector3f> known = database.colours;
  known.resize(database.points.size(), Eigen::Vector3f::Constant(-1.0f));
  PhotometricReference reference = SolvePhotometry(observations, database.keyframes.size(), known);
  database.colours = std::move(reference.colours);
  for (size_t k = 0; k < bgr.size(); ++k) {
    if (!bgr[k].empty()) {
      database.keyframes[k].gain = reference.gains[k];
    }
  }
}

}  // namespace lararium::train
