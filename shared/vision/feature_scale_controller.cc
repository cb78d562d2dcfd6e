#include "shared/vision/feature_scale_controller.h"

#include <array>
#include <cmath>

namespace lararium::vision {
namespace {

struct Level {
  int first_octave;
  float contrast_threshold;
};

// Levels from fine to coarse. Within an octave one step changes the number of features by about a
// quarter.
constexpr std::array<Level, 16> kLevels = {{{-1, 0.015f},
                                            {-1, 0.02f},
                                            {-1, 0.028f},
                                            {-1, 0.04f},
                                            {0, 0.01f},
                                            {0, 0.014f},
                                            {0, 0.02f},
                                            {0, 0.028f},
                                            {0, 0.04f},
                                            {0, 0.056f},
                                            {0, 0.08f},
                                            {1, 0.02f},
                                            {1, 0.028f},
                                            {1, 0.04f},
                                            {1, 0.056f},
                                            {1, 0.08f}}};
constexpr int kFirstLevel = 8;

// The level stays while the number of features over the budget is between these factors.
constexpr double kTooFew = 0.75;
constexpr double kTooMany = 1.4;
// Starting an octave later loses about three of four features, so the finer octave is left only if
// the remaining features still fill the budget.
constexpr double kTooManyForOctave = 5.0;

// A pose with fewer inliers or a larger error is poor and needs more features.
constexpr int kFewInliers = 40;
constexpr double kLargeErrorPx = 1.0;
// A pose with more inliers and a smaller error has plenty; features may then be fewer than the
// budget.
constexpr int kManyInliers = 300;
constexpr double kSmallErrorPx = 0.25;
// Share of the inliers that is left, at worst, after a step to a coarser level and to the next
// octave. The error rises with the inverse square root of the share.
constexpr double kPartOfStep = 0.6;
constexpr double kPartOfOctave = 0.15;

bool IsPoor(const PoseQuality& pose) {
  return pose.inliers < kFewInliers || pose.expected_error_px > kLargeErrorPx;
}

bool IsPlenty(const PoseQuality& pose) {
  return pose.inliers > kManyInliers && pose.expected_error_px < kSmallErrorPx;
}

// The quality of the pose, at worst, with a part of the inliers.
PoseQuality FromPart(const PoseQuality& pose, double part) {
  return {static_cast<int>(part * pose.inliers), pose.expected_error_px / std::sqrt(part)};
}

FeatureOptions OptionsAt(int level, int max_features) {
  FeatureOptions options;
  options.first_octave = kLevels[level].first_octave;
  options.contrast_threshold = kLevels[level].contrast_threshold;
  options.max_features = max_features;
  return options;
}

}  // namespace

FeatureScaleController::FeatureScaleController(int feature_budget)
    : budget_(feature_budget), level_(kFirstLevel) {}

FeatureOptions FeatureScaleController::options() const { return OptionsAt(level_, 6 * budget_); }

FeatureOptions FeatureScaleController::finest_options() const { return OptionsAt(0, 6 * budget_); }

void FeatureScaleController::Observe(size_t features, const std::optional<PoseQuality>& pose) {
  const auto count = static_cast<double>(features);
  const bool poor = pose && IsPoor(*pose);
  const bool too_few = count < kTooFew * budget_ && !(pose && IsPlenty(*pose));
  if (poor || too_few) {
    level_ -= level_ > 0 ? 1 : 0;
    return;
  }
  if (level_ + 1 == static_cast<int>(kLevels.size())) {
    return;
  }
  const bool same_octave = kLevels[level_ + 1].first_octave == kLevels[level_].first_octave;
  const std::optional<PoseQuality> then =
      pose ? std::optional(FromPart(*pose, same_octave ? kPartOfStep : kPartOfOctave))
           : std::nullopt;
  const bool too_many = count > (same_octave ? kTooMany : kTooManyForOctave) * budget_;
  if ((too_many && !(then && IsPoor(*then))) || (then && IsPlenty(*then))) {
    ++level_;
  }
}

}  // namespace lararium::vision
