#pragma once

// Chooses the quality level so that the frame rate is steady. It steps down as soon as frames take
// too long, and up only if the finer level is known, or expected, to fit. A level that failed is
// tried again after longer and longer intervals, so that quality does not oscillate. Heat and a low
// battery limit the quality too. Deterministic: it reads no clock.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shared/core/json_fwd.h"
#include "shared/core/status.h"

namespace lararium::show {

struct QualityOptions {
  // Expected cost of a frame at each level as a share of the finest level's cost, finest first,
  // descending. Real costs are learnt while levels are drawn.
  std::vector<double> expected_cost = {1.0, 0.7, 0.45, 0.3, 0.2};
  double budget_ms = 36.0;        // Budget of a frame's slowest stage.
  double headroom = 0.85;         // Share of the budget that a finer level may be expected to take.
  double too_long_seconds = 0.4;  // Time over the budget before a step down.
  double settle_seconds = 0.6;    // Time after a step in which frames are ignored.
  // Time with headroom before a step up; doubled after each failed step.
  double patience_seconds = 3.0;
  double first_patience_seconds = 0.4;  // The same, until the first step down.
  double most_patience_seconds = 120.0;
  // Temperature from which quality is lowered by one level, and by one more level for each further
  // celsius_per_level.
  double hot_celsius = 80.0;
  double celsius_per_level = 4.0;
  double low_battery = 0.15;  // Charge below which the finest levels are not used.
  size_t low_battery_level = 2;

  // Options for a number of levels and a camera's frame rate: a frame must be ready before the next
  // one arrives.
  static QualityOptions ForCamera(size_t level_count, double frames_per_second);

  Status Validate() const;
};

struct PowerState {
  std::optional<double> celsius;  // Temperature of the hottest part.
  std::optional<double> battery;  // Remaining charge, 0 to 1; empty: mains or unknown.
};

enum class QualityReason { kTooSlow, kHeadroom, kHot, kBattery };
std::string_view Name(QualityReason reason);

struct QualityStep {
  double time = 0.0;  // seconds
  size_t from = 0;
  size_t to = 0;
  QualityReason reason = QualityReason::kTooSlow;
};

class QualityController {
 public:
  explicit QualityController(QualityOptions options = {}, size_t level = 0);

  size_t level() const { return level_; }  // 0 is the finest level.
  size_t level_count() const { return options_.expected_cost.size(); }

  // Adds a frame that was drawn at level(): its time, and the duration of its slowest stage. Do not
  // add frames without a pose: they do not show what a level costs. Returns whether the level has
  // changed.
  bool AddFrame(double time, double work_ms);
  // Updates temperature and battery. Returns whether the level has changed.
  bool SetPower(double time, const PowerState& power);

  // The last steps, oldest first. step_count() counts all steps.
  std::span<const QualityStep> steps() const { return steps_; }
  int64_t step_count() const { return step_count_; }
  // Number of frames drawn at each level.
  std::span<const int64_t> frames() const { return frames_; }

  // {"level", "frames": at each level, "step_count", "steps": [{"time", "from", "to", "why"}]}
  Json ToJson() const;

 private:
  struct Left {
    size_t level = 0;
    double cost_ms = 0.0;
  };
  double ExpectedAt(size_t level) const;
  void Learn(double time);
  bool StepTo(double time, size_t level, QualityReason reason);

  QualityOptions options_;
  size_t level_ = 0;
  size_t least_ = 0;  // Finest level that heat and battery allow.
  PowerState power_;
  std::optional<double> smoothed_ms_;
  std::vector<double> cost_;  // Relative cost of each level, as far as known.
  std::optional<Left> left_;  // Level and cost before the last step.
  double settled_at_ = 0.0;   // Time from which frames count again.
  double last_frame_ = 0.0;   // Time of the last frame.
  std::optional<double> slow_since_;
  std::optional<double> fits_since_;
  double patience_ = 0.0;
  std::optional<double> stepped_up_at_;
  std::vector<QualityStep> steps_;
  int64_t step_count_ = 0;
  std::vector<int64_t> frames_;
};

}  // namespace lararium::show
