#include "shared/show/show_statistics.h"

#include <gtest/gtest.h>

#include "tests/show/small_show.h"

namespace lararium::show {
namespace {

TEST(TrackingStatistics, CountsWhatHappened) {
  TrackingStatistics statistics;
  test::FakePoses poses(4);  // Lost in frames 0, 4, 8.
  for (int64_t index = 0; index < 10; ++index) {
    geometry::Frame frame;
    frame.index = index;
    statistics.Add(poses.Track(frame));
  }
  EXPECT_DOUBLE_EQ(statistics.tracked_fraction(), 0.7);
  EXPECT_EQ(statistics.relocalizations(), 2);
  EXPECT_DOUBLE_EQ(statistics.mean_inliers(), 10.0);
}

TEST(TrackingStatistics, TellsFollowingFromFindingAndPlaceFromPlace) {
  ShowStatistics statistics;
  statistics.places = {"bar", "yard", "cellar"};
  for (int i = 0; i < 8; ++i) {
    vision::TrackedFrame frame;
    if (i != 3) {
      frame.camera_from_map = geometry::Rigid3();
      frame.map = i < 3 ? 1 : 0;
      frame.followed = i != 0 && i != 4;
      frame.confidence = i < 3 ? 1.0f : 0.25f;
    }
    statistics.tracking.Add(frame);
  }
  const Json json = statistics.ToJson();
  EXPECT_EQ(json["tracked_fraction"], 7.0 / 8.0);
  EXPECT_EQ(json["followed_fraction"], 5.0 / 8.0);
  EXPECT_DOUBLE_EQ(json["confidence"], 4.0 / 7.0);
  EXPECT_EQ(json["frames_in_place"], (Json{{"bar", 4}, {"yard", 3}, {"cellar", 0}}));
}

TEST(TrackingStatistics, OfNothingIsZero) {
  const TrackingStatistics statistics;
  EXPECT_EQ(statistics.tracked_fraction(), 0.0);
  EXPECT_EQ(statistics.mean_inliers(), 0.0);
}

TEST(ShowStatistics, HoldsWhatTheDesignNames) {
  const Json json = ShowStatistics().ToJson();
  for (const char* stage : {"capture", "track", "simulate", "render"}) {
    for (const char* key : {"count", "mean", "p50", "p95", "max", "cpu_p50"}) {
      EXPECT_TRUE(json[stage].contains(key)) << stage << " " << key;
    }
  }
  // Frames pass through several threads whose CPU time is not the frame's.
  EXPECT_TRUE(json["total"].contains("p95"));
  EXPECT_FALSE(json["total"].contains("cpu_p50"));
  for (const char* key : {"tracked_fraction", "followed_fraction", "relocalizations", "inliers",
                          "confidence", "frames_in_place", "peak_resident_mib", "startup_seconds",
                          "dropped_frames", "gpu", "graphics"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
}

}  // namespace
}  // namespace lararium::show
