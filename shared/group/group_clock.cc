#include "shared/group/group_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace lararium::group {
namespace {

constexpr int64_t kBucketTime = 4'000'000;
constexpr size_t kMostBuckets = 45;          // Three minutes.
constexpr int64_t kDriftSpan = 40'000'000;   // Drift is estimated from at least this time.
constexpr double kMostDrift = 300e-6;        // Quartzes are better than this.
constexpr int64_t kMostDelay = 5'000'000;    // Later answers say nothing.
constexpr int64_t kOtherTime = 2'000'000;    // No delay explains a larger difference.
constexpr int64_t kLongestEcho = 5'000'000;  // A leader answers within this time.
constexpr int64_t kWorstDelay = 20'000;      // Longer than the shortest: hardly counts.

double Median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void GroupClock::Begin(int64_t own, int64_t group) {
  *this = {};
  known_ = true;
  reference_ = own;
  offset_ = group - own;
}

void GroupClock::Lead(int64_t own) {
  const int64_t group = GroupTime(own);
  Begin(own, group);
}

int64_t GroupClock::GroupTime(int64_t own) const {
  return own + offset_ + std::llround(drift_ * static_cast<double>(own - reference_));
}

int64_t GroupClock::OwnTime(int64_t group) const {
  const auto passed = static_cast<double>(group - offset_ - reference_);
  return reference_ + std::llround(passed / (1.0 + drift_));
}

void GroupClock::Add(const Exchange& exchange) {
  const int64_t waited = exchange.group_sent - exchange.group_received;
  const int64_t delay = exchange.received - exchange.sent - waited;
  if (waited < 0 || waited > kLongestEcho || delay < 0 || delay > kMostDelay ||
      exchange.sent <= last_sent_) {
    return;
  }
  const Sample sample = {
      exchange.received,
      (exchange.group_received - exchange.sent + exchange.group_sent - exchange.received) / 2,
      delay};
  const int64_t expected = GroupTime(sample.own) - sample.own;
  if (!known_ || std::abs(sample.offset - expected) > kOtherTime + delay / 2) {
    Begin(sample.own, sample.own + sample.offset);
  }
  last_sent_ = exchange.sent;
  ++exchanges_;
  const int64_t number = sample.own / kBucketTime;
  if (buckets_.empty() || buckets_.back().number != number) {
    buckets_.push_back({number, sample});
  } else if (sample.delay < buckets_.back().best.delay) {
    buckets_.back().best = sample;
  }
  if (buckets_.size() > kMostBuckets) {
    buckets_.pop_front();
  }
  Fit(sample.own);
}

// The drift is the median of the slopes between all pairs of samples (Theil and Sen), of which
// almost a third may be wrong. The offset is a mean in which samples of short delay count most.
void GroupClock::Fit(int64_t own) {
  delay_ = std::min_element(buckets_.begin(), buckets_.end(), [](const auto& a, const auto& b) {
             return a.best.delay < b.best.delay;
           })->best.delay;
  std::vector<double> slopes;
  for (size_t i = 0; i < buckets_.size(); ++i) {
    for (size_t j = i + 1; j < buckets_.size(); ++j) {
      const Sample& a = buckets_[i].best;
      const Sample& b = buckets_[j].best;
      if (b.own - a.own >= kDriftSpan / 2) {
        slopes.push_back(static_cast<double>(b.offset - a.offset) /
                         static_cast<double>(b.own - a.own));
      }
    }
  }
  const bool long_enough = buckets_.back().best.own - buckets_.front().best.own >= kDriftSpan;
  drift_ =
      long_enough && !slopes.empty() ? std::clamp(Median(slopes), -kMostDrift, kMostDrift) : drift_;
  double weights = 0.0;
  double sum = 0.0;
  const int64_t base = buckets_.back().best.offset;
  for (const Bucket& bucket : buckets_) {
    const Sample& sample = bucket.best;
    const double worse = static_cast<double>(sample.delay - delay_) / kWorstDelay;
    const double weight = std::exp(-4.0 * worse);
    const double now =
        static_cast<double>(sample.offset - base) + drift_ * static_cast<double>(own - sample.own);
    weights += weight;
    sum += weight * now;
  }
  reference_ = own;
  offset_ = base + std::llround(sum / weights);
}

}  // namespace lararium::group
