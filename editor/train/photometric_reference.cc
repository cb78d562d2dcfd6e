#include "editor/train/photometric_reference.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "shared/core/check.h"
#include "shared/core/parallel.h"

namespace lararium::train {
namespace {

constexpr int kIterations = 12;
// Of the loss: a sight at so many robust deviations counts half.
constexpr double kLossDeviations = 2.0;
constexpr double kLeastDeviation = 0.01;  // quantisation alone gives so much
// Sum of a point's trusted weights from which its colour is worth keeping.
constexpr double kLeastWeight = 0.3;
// Pulls gains that nothing else holds towards 1, in units of one sight's weight.
constexpr double kPriorWeight = 1e-3;

// One channel of one sight.
struct Sight {
  uint32_t point;
  uint32_t keyframe;
  double log;     // of its linear value
  double weight;  // as sampled
  double robust;  // weight times the loss's, of this iteration
};

// One channel's least squares.
class ChannelSolver {
 public:
  ChannelSolver(std::span<const ColourSight> sights,
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
    for (const ColourSight& sight : sights) {
      const double weight = sight.colour.weight[channel];
      if (weight > 0.0) {
        sights_.push_back({sight.point, sight.keyframe,
                           std::log(static_cast<double>(sight.colour.rgb[channel])), weight,
                           weight});
      }
    }
    std::stable_sort(sights_.begin(), sights_.end(),
                     [](const Sight& a, const Sight& b) { return a.point < b.point; });
  }

  void Solve() {
    for (int i = 0; i < kIterations && !sights_.empty(); ++i) {
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

  // [points], negative where no sight tells.
  std::vector<float> Colours() const {
    std::vector<float> colours(log_colours_.size(), -1.0f);
    ForEachPoint([&](size_t point, std::span<const Sight> sights) {
      double weight = 0.0;
      for (const Sight& sight : sights) {
        weight += sight.robust;
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
    for (size_t begin = 0; begin < sights_.size();) {
      size_t end = begin;
      while (end < sights_.size() && sights_[end].point == sights_[begin].point) {
        ++end;
      }
      visit(sights_[begin].point, std::span(sights_).subspan(begin, end - begin));
      begin = end;
    }
  }

  static double MeanLog(std::span<const Sight> sights) {
    double sum = 0.0;
    double weight = 0.0;
    for (const Sight& sight : sights) {
      sum += sight.robust * sight.log;
      weight += sight.robust;
    }
    return sum / weight;
  }

  void SolveGains() {
    const Eigen::Index count = log_gains_.size();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(count, count) * kPriorWeight;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    ForEachPoint([&](size_t point, std::span<const Sight> sights) {
      const double mean = known_[point] ? log_colours_[point] : MeanLog(sights);
      double total = 0.0;
      for (const Sight& sight : sights) {
        normal(sight.keyframe, sight.keyframe) += sight.robust;
        right[sight.keyframe] += sight.robust * (sight.log - mean);
        total += sight.robust;
      }
      if (known_[point]) {
        return;
      }
      for (const Sight& a : sights) {
        for (const Sight& b : sights) {
          normal(a.keyframe, b.keyframe) -= a.robust * b.robust / total;
        }
      }
    });
    log_gains_ = normal.ldlt().solve(right);
  }

  void SolveColours() {
    ForEachPoint([&](size_t point, std::span<const Sight> sights) {
      if (known_[point]) {
        return;
      }
      double sum = 0.0;
      double weight = 0.0;
      for (const Sight& sight : sights) {
        sum += sight.robust * (sight.log - log_gains_[sight.keyframe]);
        weight += sight.robust;
      }
      log_colours_[point] = sum / weight;
    });
  }

  double Residual(const Sight& sight) const {
    return sight.log - log_gains_[sight.keyframe] - log_colours_[sight.point];
  }

  void Reweigh() {
    std::vector<double> sizes;
    sizes.reserve(sights_.size());
    for (const Sight& sight : sights_) {
      sizes.push_back(std::abs(Residual(sight)));
    }
    const auto middle = sizes.begin() + static_cast<ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    constexpr double kDeviationOfMedian = 1.4826;  // of normally distributed residuals
    const double scale = kLossDeviations * std::max(kDeviationOfMedian * *middle, kLeastDeviation);
    for (Sight& sight : sights_) {
      const double r = Residual(sight) / scale;
      sight.robust = sight.weight / (1.0 + r * r);
    }
  }

  void FixGauge() {
    std::vector<bool> seen(static_cast<size_t>(log_gains_.size()), false);
    for (const Sight& sight : sights_) {
      seen[sight.keyframe] = true;
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

  std::vector<Sight> sights_;  // sorted by point
  Eigen::VectorXd log_gains_;
  std::vector<double> log_colours_;
  std::vector<bool> known_;  // [points]
  bool any_known_ = false;
};

std::vector<ColourSight> SampleSights(const vision::SceneDatabase& database,
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
  std::vector<ColourSight> sights;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (samples[i]) {
      sights.push_back({observations[i].point, observations[i].keyframe, *samples[i]});
    }
  }
  return sights;
}

}  // namespace

PhotometricReference SolvePhotometry(std::span<const ColourSight> sights,
                                     size_t keyframe_count,
                                     std::span<const Eigen::Vector3f> known) {
  for (const ColourSight& sight : sights) {
    CHECK(sight.point < known.size() && sight.keyframe < keyframe_count);
  }
  PhotometricReference reference;
  reference.colours.assign(known.begin(), known.end());
  reference.gains.resize(keyframe_count);
  ParallelFor(3, [&](size_t channel) {
    ChannelSolver solver(sights, keyframe_count, known, static_cast<int>(channel));
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
  const std::vector<ColourSight> sights = SampleSights(database, bgr);
  if (sights.empty()) {
    return;
  }
  std::vector<Eigen::Vector3f> known = database.colours;
  known.resize(database.points.size(), Eigen::Vector3f::Constant(-1.0f));
  PhotometricReference reference = SolvePhotometry(sights, database.keyframes.size(), known);
  database.colours = std::move(reference.colours);
  for (size_t k = 0; k < bgr.size(); ++k) {
    if (!bgr[k].empty()) {
      database.keyframes[k].gain = reference.gains[k];
    }
  }
}

}  // namespace lararium::train
