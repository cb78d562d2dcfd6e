#include "editor/document/frame_times.h"

#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

constexpr double kRate = 30000.0 / 1001.0;  // The rate of NTSC cameras.
constexpr double kDuration = 20.0;

TEST(TimeOfStep, GoesFromFrameToFrameAndBackOnTheVeryMoments) {
  double time = 0.0;
  for (int64_t frame = 1; frame <= 500; ++frame) {
    time = TimeOfStep(time, 1, kRate, kDuration);
    ASSERT_EQ(time, static_cast<double>(frame) / kRate);
  }
  for (int64_t frame = 499; frame >= 0; --frame) {
    time = TimeOfStep(time, -1, kRate, kDuration);
    ASSERT_EQ(time, static_cast<double>(frame) / kRate);
  }
}

TEST(TimeOfStep, FromWithinAFrameGoesToTheNextOneAndBackToTheOneBefore) {
  const double within = 10.4 / kRate;
  EXPECT_EQ(TimeOfStep(within, 1, kRate, kDuration), 11.0 / kRate);
  EXPECT_EQ(TimeOfStep(within, -1, kRate, kDuration), 9.0 / kRate);
}

TEST(TimeOfStep, StopsAtTheLastFrameAndGoesBackFromBehindIt) {
  EXPECT_DOUBLE_EQ(TimeOfStep(kDuration - 1.0 / 25.0, 1, 25.0, kDuration), kDuration - 1.0 / 25.0);
  EXPECT_DOUBLE_EQ(TimeOfStep(kDuration + 3.0, 1, 25.0, kDuration), kDuration + 3.0);
  EXPECT_DOUBLE_EQ(TimeOfStep(kDuration + 3.0, -1, 25.0, kDuration), kDuration + 3.0 - 1.0 / 25.0);
}

}  // namespace
}  // namespace lararium::editor
