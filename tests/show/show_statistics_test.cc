#include "shared/show/show_statistics.h"

#include <gtest/gtest.h>

#include "tests/show/small_show.h"

namespace lararium::show {
namespace {

TEST(TrackingStatistics, CountsWhatHappened) {
  TrackingStatistics statistics;
  test::FakePoses poses(4);  // lost in frames 0, 4, 8
  for (int64_t index = 0; index < 10; ++index) {
    geometry::Frame frame;
    frame.index = index;
    statistics.Add(poses.Track(frame));
  }
  EXPECT_DOUBLE_EQ(statistics.tracked_fraction(), 0.7);
  EXPECT_EQ(statistics.relocalizations(), 2);
  EXPECT_DOUBLE_EQ(statistics.mean_inliers(), 10.0);
}

TEST(TrackingStatistics, OfNothingIsZero) {
  const TrackingStatistics statistics;
  EXPECT_EQ(statistics.tracked_fraction(), 0.0);
  EXPECT_EQ(statistics.mean_inliers(), 0.0);
}

TEST(ShowStatistics, HoldsWhatTheDesignNames) {
  const Json json = ShowStatistics().ToJson();
  for (const char* stage : {"capture", "track", "simulate", "render", "total"}) {
    for (const char* key : {"count", "mean", "p50", "p95", "max", "cpu_p50"}) {
      EXPECT_TRUE(json[stage].contains(key)) << stage << " " << key;
    }
  }
  for (const char* key : {"tracked_fraction", "relocalizations", "inliers", "peak_resident_mib",
                          "startup_seconds", "dropped_frames", "gpu"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
}

}  // namespace
}  // namespace lararium::show
