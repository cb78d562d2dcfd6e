#include "shared/show/quality_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/core/check.h"
#include "shared/core/json.h"

namespace lararium::show {
namespace {

constexpr size_t kKeptSteps = 256;
// Share of the time between two camera images that the slowest stage may take.
constexpr double kBudgetShare = 0.95;
// Assumed cost relative to the next finer level, until measured.
constexpr double kCostOfLevel = 0.6;
constexpr double kNewest = 0.15;  // Weight of a frame in the mean.
// A step up that is reversed within this many seconds has failed.
constexpr double kInVainSeconds = 10.0;
// Time after settling until a level's cost is known.
constexpr double kLearningSeconds = 0.5;
// A gap between frames of this length ends a period of headroom.
constexpr double kPauseSeconds = 0.5;
// Smaller falls of temperature or rises of charge are ignored.
constexpr double kCelsiusSlack = 3.0;
constexpr double kBatterySlack = 0.05;

}  // namespace

QualityOptions QualityOptions::ForCamera(size_t level_count, double frames_per_second) {
  QualityOptions options;
  options.expected_cost.resize(level_count);
  for (size_t i = 0; i < level_count; ++i) {
    options.expected_cost[i] = std::pow(kCostOfLevel, static_cast<double>(i));
  }
  options.budget_ms = kBudgetShare * 1000.0 / std::clamp(frames_per_second, 15.0, 60.0);
  return options;
}

Status QualityOptions::Validate() const {
  if (expected_cost.empty() || expected_cost.front() <= 0.0 ||
      !std::is_sorted(expected_cost.rbegin(), expected_cost.rend()) ||
      expected_cost.back() <= 0.0) {
    return Status::Error("quality", "the levels' costs must be positive and descend");
  }
  if (!(budget_ms > 0.0 && headroom > 0.0 && headroom <= 1.0 && patience_seconds > 0.0 &&
        celsius_per_level > 0.0)) {
    return Status::Error("quality", "budget, headroom, patience and degrees must be positive");
  }
  return Status();
}

std::string_view Name(QualityReason reason) {
  switch (reason) {
    case QualityReason::kTooSlow:
      return "frames take too long";
    case QualityReason::kHeadroom:
      return "there is time to spare";
    case QualityReason::kHot:
      return "the device is hot";
    case QualityReason::kBattery:
      return "the battery is low";
  }
  return "";
}

QualityController::QualityController(QualityOptions options, size_t level)
    : options_(std::move(options)),
      level_(std::min(level, options_.expected_cost.size() - 1)),
      cost_(options_.expected_cost),
      patience_(options_.first_patience_seconds),
      frames_(options_.expected_cost.size(), 0) {
  CHECK(options_.Validate().ok());
  steps_.reserve(kKeptSteps);
}

// Scales by relative costs: when the scene changes, the costs of all levels change in proportion.
double QualityController::ExpectedAt(size_t level) const {
  return smoothed_ms_.value_or(0.0) * cost_[level] / cost_[level_];
}

// Learns the cost ratio of two adjacent levels when one was drawn right after the other.
void QualityController::Learn(double time) {
  if (!left_ || time < settled_at_ + kLearningSeconds) {
    return;
  }
  const auto [from, cost_ms] = *std::exchange(left_, std::nullopt);
  const size_t finer = std::min(from, level_);
  if (std::max(from, level_) != finer + 1 || !(cost_ms > 0.0 && *smoothed_ms_ > 0.0)) {
    return;
  }
  const double ratio = from < level_ ? cost_ms / *smoothed_ms_ : *smoothed_ms_ / cost_ms;
  const double scale = std::max(ratio, 1.0) * cost_[finer + 1] / cost_[finer];
  for (size_t i = 0; i <= finer; ++i) {
    cost_[i] *= scale;
  }
}

bool QualityController::StepTo(double time, size_t level, QualityReason reason) {
  if (level == level_) {
    return false;
  }
  if (steps_.size() == kKeptSteps) {
    steps_.erase(steps_.begin());
  }
  steps_.push_back({time, level_, level, reason});
  left_.reset();
  if (smoothed_ms_) {
    left_ = Left{level_, *smoothed_ms_};
  }
  ++step_count_;
  level_ = level;
  smoothed_ms_.reset();
  slow_since_.reset();
  fits_since_.reset();
  settled_at_ = time + options_.settle_seconds;
  return true;
}

bool QualityController::AddFrame(double time, double work_ms) {
  ++frames_[level_];
  if (time - std::exchange(last_frame_, time) > kPauseSeconds) {
    fits_since_.reset();
  }
  if (time < settled_at_ || !std::isfinite(work_ms)) {
    return false;
  }
  smoothed_ms_ = smoothed_ms_ ? *smoothed_ms_ + kNewest * (work_ms - *smoothed_ms_) : work_ms;
  Learn(time);
  if (stepped_up_at_ && time - *stepped_up_at_ > kInVainSeconds) {
    patience_ = std::min(patience_, options_.patience_seconds);  // The step up succeeded.
    stepped_up_at_.reset();
  }
  if (*smoothed_ms_ > options_.budget_ms) {
    fits_since_.reset();
    slow_since_ = slow_since_.value_or(time);
    if (time - *slow_since_ < options_.too_long_seconds || level_ + 1 == level_count()) {
      return false;
    }
    if (stepped_up_at_) {
      patience_ = std::min(2.0 * patience_, options_.most_patience_seconds);
      stepped_up_at_.reset();
    }
    patience_ = std::max(patience_, options_.patience_seconds);
    // Step down as far as needed at once.
    size_t level = level_ + 1;
    while (level + 1 < level_count() && ExpectedAt(level) > options_.budget_ms) {
      ++level;
    }
    return StepTo(time, level, QualityReason::kTooSlow);
  }
  slow_since_.reset();
  if (level_ <= least_ || ExpectedAt(level_ - 1) > options_.headroom * options_.budget_ms) {
    fits_since_.reset();
    return false;
  }
  fits_since_ = fits_since_.value_or(time);
  if (time - *fits_since_ < patience_) {
    return false;
  }
  stepped_up_at_ = time;
  return StepTo(time, level_ - 1, QualityReason::kHeadroom);
}

bool QualityController::SetPower(double time, const PowerState& power) {
  const auto changed = [](std::optional<double> before, std::optional<double> now, double slack) {
    return before.has_value() != now.has_value() || (now && std::abs(*now - *before) >= slack);
  };
  // Ignore small changes for the better, so that quality does not oscillate around a limit.
  if (changed(power_.celsius, power.celsius, kCelsiusSlack) ||
      power.celsius.value_or(0.0) > power_.celsius.value_or(0.0)) {
    power_.celsius = power.celsius;
  }
  if (changed(power_.battery, power.battery, kBatterySlack) ||
      power.battery.value_or(1.0) < power_.battery.value_or(1.0)) {
    power_.battery = power.battery;
  }
  size_t by_heat = 0;
  if (power_.celsius && *power_.celsius >= options_.hot_celsius) {
    by_heat = 1 + static_cast<size_t>((*power_.celsius - options_.hot_celsius) /
                                      options_.celsius_per_level);
  }
  const bool low = power_.battery && *power_.battery < options_.low_battery;
  const size_t by_battery = low ? options_.low_battery_level : 0;
  const size_t before = least_;
  least_ = std::min(std::max(by_heat, by_battery), level_count() - 1);
  if (level_ < least_) {
    return StepTo(time, least_,
                  by_heat >= by_battery ? QualityReason::kHot : QualityReason::kBattery);
  }
  // A level that heat or battery excluded returns when frame times allow it.
  if (least_ < before) {
    fits_since_.reset();
    patience_ = options_.patience_seconds;
  }
  return false;
}

Json QualityController::ToJson() const {
  Json steps = Json::array();
  for (const QualityStep& step : steps_) {
    steps.push_back({{"time", step.time},
                     {"from", step.from},
                     {"to", step.to},
                     {"why", std::string(Name(step.reason))}});
  }
  return {{"level", level_}, {"frames", frames_}, {"step_count", step_count_}, {"steps", steps}};
}

}  // namespace lararium::show
