#include "shared/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "shared/core/json.h"

namespace lararium {
namespace {

constexpr double kSmallestMs = 1e-3;
constexpr double kBinRatio = 1.01;

}  // namespace

double ThreadCpuMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void DurationHistogram::Add(double milliseconds) {
  const double bin =
      std::log(std::max(milliseconds, kSmallestMs) / kSmallestMs) / std::log(kBinRatio);
  ++bins_[std::min(static_cast<size_t>(bin), kBins - 1)];
  ++count_;
  sum_ += milliseconds;
  max_ = std::max(max_, milliseconds);
}

double DurationHistogram::mean() const {
  return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_);
}

double DurationHistogram::Quantile(double q) const {
  if (count_ == 0) {
    return 0.0;
  }
  const auto rank =
      static_cast<uint64_t>(std::lround(std::clamp(q, 0.0, 1.0) * static_cast<double>(count_ - 1)));
  uint64_t below = 0;
  for (size_t bin = 0; bin < kBins; ++bin) {
    below += bins_[bin];
    if (below > rank) {
      const double middle = kSmallestMs * std::pow(kBinRatio, static_cast<double>(bin) + 0.5);
      return std::min(middle, max_);
    }
  }
  return max_;
}

Json DurationHistogram::ToJson() const {
  return {{"count", count_},
          {"mean", mean()},
          {"p50", Quantile(0.50)},
          {"p95", Quantile(0.95)},
          {"max", max_}};
}

void StageTimes::Add(double wall_ms, double cpu_ms) {
  wall_.Add(wall_ms);
  cpu_.Add(cpu_ms);
}

Json StageTimes::ToJson() const {
  Json json = wall_.ToJson();
  json["cpu_mean"] = cpu_.mean();
  json["cpu_p50"] = cpu_.Quantile(0.50);
  json["cpu_p95"] = cpu_.Quantile(0.95);
  return json;
}

}  // namespace lararium
