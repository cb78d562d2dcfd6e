#pragma once

// Durations of pipeline stages, in the format of stats.json.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "shared/core/json_fwd.h"

namespace lararium {

// Returns the processor time that the calling thread has used, in milliseconds.
double ThreadCpuMilliseconds();

// The distribution of durations in constant memory for any run time: logarithmic bins from a
// microsecond to a quarter of an hour, 1 % wide. Count, mean and maximum are exact; quantiles are
// accurate to half a bin.
class DurationHistogram {
 public:
  void Add(double milliseconds);
  uint64_t count() const { return count_; }
  double mean() const;
  double max() const { return max_; }
  double Quantile(double q) const;
  // {"count", "mean", "p50", "p95", "max"}
  Json ToJson() const;

 private:
  static constexpr size_t kBins = 2080;
  std::array<uint32_t, kBins> bins_ = {};
  uint64_t count_ = 0;
  double sum_ = 0.0;
  double max_ = 0.0;
};

// Wall and processor milliseconds of one stage, one sample per frame.
class StageTimes {
 public:
  void Add(double wall_ms, double cpu_ms);
  // {"count", "mean", "p50", "p95", "max", "cpu_mean", "cpu_p50", "cpu_p95"}
  Json ToJson() const;

 private:
  DurationHistogram wall_;
  DurationHistogram cpu_;
};

// Adds the time from construction to destruction to a StageTimes.
class ScopedStageTimer {
 public:
  explicit ScopedStageTimer(StageTimes& times)
      : times_(times),
        start_(std::chrono::steady_clock::now()),
        start_cpu_ms_(ThreadCpuMilliseconds()) {}
  ~ScopedStageTimer() {
    const std::chrono::duration<double, std::milli> wall =
        std::chrono::steady_clock::now() - start_;
    times_.Add(wall.count(), ThreadCpuMilliseconds() - start_cpu_ms_);
  }
  // Adds processor time that other threads spent on the same work.
  void AddCpu(double milliseconds) { start_cpu_ms_ -= milliseconds; }
  ScopedStageTimer(const ScopedStageTimer&) = delete;
  ScopedStageTimer& operator=(const ScopedStageTimer&) = delete;

 private:
  StageTimes& times_;
  std::chrono::steady_clock::time_point start_;
  double start_cpu_ms_;
};

}  // namespace lararium
