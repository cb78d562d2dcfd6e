#include "shared/vision/level_of_detail.h"

#include <array>

namespace lararium::vision {
namespace {

struct Level {
  int first_octave;
  float contrast_threshold;
};

// From fine to coarse. Within an octave one step changes the number of features
// by about a quarter.
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

// Off by less than these factors the level stays.
constexpr double kTooFew = 0.75;
constexpr double kTooMany = 1.4;
// Starting an octave later loses about three features of four: leave the finer
// octave only where that still fills the budget.
constexpr double kTooManyForOctave = 5.0;

FeatureOptions OptionsAt(int level, int max_features) {
  FeatureOptions options;
  options.first_octave = kLevels[level].first_octave;
  options.contrast_threshold = kLevels[level].contrast_threshold;
  options.max_features = max_features;
  return options;
}

}  // namespace

LevelOfDetail::LevelOfDetail(int feature_budget) : budget_(feature_budget), level_(kFirstLevel) {}

FeatureOptions LevelOfDetail::options() const { return OptionsAt(level_, 6 * budget_); }

FeatureOptions LevelOfDetail::finest_options() const { return OptionsAt(0, 6 * budget_); }

void LevelOfDetail::Observe(size_t features) {
  const auto count = static_cast<double>(features);
  if (count < kTooFew * budget_ && level_ > 0) {
    --level_;
  } else if (level_ + 1 < static_cast<int>(kLevels.size())) {
    const bool same_octave = kLevels[level_ + 1].first_octave == kLevels[level_].first_octave;
    level_ += count > (same_octave ? kTooMany : kTooManyForOctave) * budget_ ? 1 : 0;
  }
}

}  // namespace lararium::vision
