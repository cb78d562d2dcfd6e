#pragma once

// Durations of a pipeline stage, as stats.json reports them.

#include <chrono>
#include <vector>

#include "shared/core/json.h"

namespace lararium {

// The q-quantile (0..1) by the nearest rank; 0 of nothing.
double Quantile(std::vector<double> values, double q);

// Processor time that the calling thread has used, in milliseconds.
double ThreadCpuMilliseconds();

// Wall and processor milliseconds of one stage, one sample per frame. Reserve
// ahead to keep the frame loop free of allocation.
class StageTimes {
 public:
  void Reserve(size_t frames);
  void Add(double wall_ms, double cpu_ms);
  // {"count", "mean", "p50", "p95", "max", "cpu_mean", "cpu_p50", "cpu_p95"}
  Json ToJson() const;

 private:
  std::vector<double> wall_ms_;
  std::vector<double> cpu_ms_;
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
  ScopedStageTimer(const ScopedStageTimer&) = delete;
  ScopedStageTimer& operator=(const ScopedStageTimer&) = delete;

 private:
  StageTimes& times_;
  std::chrono::steady_clock::time_point start_;
  double start_cpu_ms_;
};

}  // namespace lararium
