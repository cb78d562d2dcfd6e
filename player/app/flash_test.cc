#include "player/app/flash_test.h"

#include <algorithm>
#include <cmath>

namespace lararium::player {
namespace {

// Intervals between changes are long enough for slow displays, and irregular, so that only one
// delay fits.
constexpr double kShortest = 0.2;  // seconds
constexpr double kLongest = 0.7;
constexpr double kMostDelay = 1.0;
constexpr double kFlashStep = 0.0005;
constexpr size_t kLeastSeen = 60;
constexpr double kLeastAgreement = 0.6;

}  // namespace

bool FlashTest::Show(double time) {
  if (changes_.empty() || time >= next_change_) {
    changes_.push_back({time, changes_.empty() || !changes_.back().white});
    next_change_ = time + random_.Uniform(kShortest, kLongest);
  }
  return changes_.back().white;
}

void FlashTest::See(double time, double brightness) { seen_.push_back({time, brightness}); }

double FlashTest::ShownAt(double time) const {
  const auto after =
      std::upper_bound(changes_.begin(), changes_.end(), time,
                       [](double t, const Change& change) { return t < change.time; });
  return after != changes_.begin() && (after - 1)->white ? 1.0 : -1.0;
}

double FlashTest::AgreementAt(double delay, double mean) const {
  double product = 0.0, seen = 0.0, shown = 0.0, sum = 0.0;
  double count = 0.0;
  for (const Seen& image : seen_) {
    if (image.time - kMostDelay >= changes_.front().time) {
      sum += ShownAt(image.time - delay);
      count += 1.0;
    }
  }
  const double shown_mean = sum / std::max(count, 1.0);
  for (const Seen& image : seen_) {
    if (image.time - kMostDelay >= changes_.front().time) {
      const double s = ShownAt(image.time - delay) - shown_mean;
      const double b = image.brightness - mean;
      product += s * b;
      seen += b * b;
      shown += s * s;
    }
  }
  return seen > 0.0 && shown > 0.0 ? product / std::sqrt(seen * shown) : 0.0;
}

std::optional<FlashResult> FlashTest::Result() const {
  if (seen_.size() < kLeastSeen || changes_.empty()) {
    return std::nullopt;
  }
  double mean = 0.0;
  double count = 0.0;
  for (const Seen& image : seen_) {
    if (image.time - kMostDelay >= changes_.front().time) {
      mean += image.brightness;
      count += 1.0;
    }
  }
  mean /= std::max(count, 1.0);
  // Images have an interval, so a range of delays agrees equally well. The middle of it is used.
  FlashResult best;
  double first = 0.0, last = 0.0;
  for (double delay = 0.0; delay <= kMostDelay; delay += kFlashStep) {
    const double agreement = AgreementAt(delay, mean);
    if (agreement > best.agreement + 1e-9) {
      best.agreement = agreement;
      first = last = delay;
    } else if (agreement > best.agreement - 1e-9) {
      last = delay;
    }
  }
  best.latency_ms = 1000.0 * 0.5 * (first + last);
  return best.agreement >= kLeastAgreement ? std::optional(best) : std::nullopt;
}

}  // namespace lararium::player
