#include "shared/core/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/random.h"

namespace lararium {
namespace {

// The exact quantile, by the nearest rank.
double SortedQuantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(std::lround(q * static_cast<double>(values.size() - 1)))];
}

TEST(DurationHistogram, QuantilesAgreeWithSortingToABin) {
  Random random(1);
  DurationHistogram histogram;
  std::vector<double> values;
  for (int i = 0; i < 10'000; ++i) {
    values.push_back(std::exp(random.Normal() + 1.0));
    histogram.Add(values.back());
  }
  for (const double q : {0.0, 0.05, 0.5, 0.95, 0.999}) {
    EXPECT_NEAR(histogram.Quantile(q) / SortedQuantile(values, q), 1.0, 0.02) << q;
  }
  EXPECT_NEAR(histogram.Quantile(1.0) / histogram.max(), 1.0, 0.01);
}

TEST(DurationHistogram, HoldsAnyDuration) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.Quantile(0.5), 0.0);
  histogram.Add(0.0);
  histogram.Add(1e12);
  EXPECT_EQ(histogram.count(), 2u);
  EXPECT_EQ(histogram.max(), 1e12);
}

TEST(StageTimes, ReportsWhatWasAdded) {
  StageTimes times;
  times.Add(1.0, 0.5);
  times.Add(3.0, 1.5);
  const Json json = times.ToJson();
  EXPECT_EQ(json["count"], 2);
  EXPECT_DOUBLE_EQ(json["mean"], 2.0);
  EXPECT_DOUBLE_EQ(json["max"], 3.0);
  EXPECT_DOUBLE_EQ(json["cpu_mean"], 1.0);
}

}  // namespace
}  // namespace lararium
