#include "shared/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

namespace lararium {
namespace {

double Mean(const std::vector<double>& values) {
  return values.empty() ? 0.0
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

}  // namespace

double Quantile(std::vector<double> values, double q) {
  if (values.empty()) {
    return 0.0;
  }
  const auto last = static_cast<double>(values.size() - 1);
  const auto rank = static_cast<size_t>(std::lround(std::clamp(q, 0.0, 1.0) * last));
  std::nth_element(values.begin(), values.begin() + static_cast<ptrdiff_t>(rank), values.end());
  return values[rank];
}

double ThreadCpuMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void StageTimes::Reserve(size_t frames) {
  wall_ms_.reserve(frames);
  cpu_ms_.reserve(frames);
}

void StageTimes::Add(double wall_ms, double cpu_ms) {
  wall_ms_.push_back(wall_ms);
  cpu_ms_.push_back(cpu_ms);
}

Json StageTimes::ToJson() const {
  return {{"count", wall_ms_.size()},           {"mean", Mean(wall_ms_)},
          {"p50", Quantile(wall_ms_, 0.50)},    {"p95", Quantile(wall_ms_, 0.95)},
          {"max", Quantile(wall_ms_, 1.0)},     {"cpu_mean", Mean(cpu_ms_)},
          {"cpu_p50", Quantile(cpu_ms_, 0.50)}, {"cpu_p95", Quantile(cpu_ms_, 0.95)}};
}

}  // namespace lararium
