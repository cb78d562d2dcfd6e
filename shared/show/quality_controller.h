#pragma once

// Which level of quality is drawn, so that the frame rate is steady: down as soon as frames take
// too long, up only where the finer level is known, or expected, to fit. A level that was tried
// in vain is tried again later and later, so that nothing swings. Heat and an empty battery hold
// the quality down too. A pure function of what it is told: it reads no clock.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::show {

struct QualityOptions {
  // What a frame costs at each level, the finest first, as shares of the finest: descending. What
  // it really costs is learnt as levels are drawn.
  std::vector<double> expected_cost = {1.0, 0.7, 0.45, 0.3, 0.2};
  double budget_ms = 36.0;              // of the slowest stage of a frame
  double headroom = 0.85;               // share of it that a finer level may be expected to take
  double too_long_seconds = 0.4;        // of frames over the budget before a step down
  double settle_seconds = 0.6;          // after each step, before frames count again
  double patience_seconds = 3.0;        // of headroom before a step up; doubled by each vain one
  double first_patience_seconds = 0.4;  // the same, until the first step down
  double most_patience_seconds = 120.0;
  double hot_celsius = 80.0;  // from here on coarser by a level for each further
  double celsius_per_level = 4.0;
  double low_battery = 0.15;  // share below which the finest levels are not drawn
  size_t low_battery_level = 2;

  // Of a ladder of so many levels, for a camera's rate: a frame is to be ready before the next.
  static QualityOptions ForCamera(size_t level_count, double frames_per_second);

  Status Validate() const;
};

struct PowerState {
  std::optional<double> celsius;  // of the hottest part
  std::optional<double> battery;  // share that is left; none: on mains, or not known
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

  size_t level() const { return level_; }  // 0 is the finest
  size_t level_count() const { return options_.expected_cost.size(); }

  // A frame with the show in it was drawn at level(): when, and what its slowest stage took. Frames
  // without, while the place is not found, tell nothing of what a level costs, and are not to be
  // told. Says whether the level is another one now.
  bool AddFrame(double time, double work_ms);
  // Heat and battery, whenever they are read.
  bool SetPower(double time, const PowerState& power);

  // The last steps, oldest first; and how many there were.
  std::span<const QualityStep> steps() const { return steps_; }
  int64_t step_count() const { return step_count_; }
  // Frames that were drawn at each level.
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
  size_t least_ = 0;  // by heat and battery: no finer than this
  PowerState power_;
  std::optional<double> smoothed_ms_;
  std::vector<double> cost_;  // of each level in proportion, as far as it is known
  std::optional<Left> left_;  // before the last step
  double settled_at_ = 0.0;   // when frames count again
  double last_frame_ = 0.0;   // when there was one
  std::optional<double> slow_since_;
  std::optional<double> fits_since_;
  double patience_ = 0.0;
  std::optional<double> stepped_up_at_;
  std::vector<QualityStep> steps_;
  int64_t step_count_ = 0;
  std::vector<int64_t> frames_;
};

}  // namespace lararium::show
