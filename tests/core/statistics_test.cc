#include "shared/core/statistics.h"

#include <gtest/gtest.h>

namespace lararium {
namespace {

TEST(Quantile, TakesTheNearestRank) {
  EXPECT_EQ(Quantile({}, 0.5), 0.0);
  EXPECT_EQ(Quantile({3, 1, 2}, 0.5), 2.0);
  EXPECT_EQ(Quantile({3, 1, 2}, 1.0), 3.0);
  EXPECT_EQ(Quantile({3, 1, 2}, 0.0), 1.0);
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
