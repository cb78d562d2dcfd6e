#include "player/app/flash_test.h"

#include <gtest/gtest.h>

#include <vector>

namespace lararium::player {
namespace {

// A display drawn at 60 Hz, and a camera at 30 Hz that sees it with a delay and noise.
std::optional<FlashResult> Measure(double latency,
                                   double noise,
                                   double seconds,
                                   bool looks = true) {
  FlashTest test(5);
  Random random(9);
  std::vector<std::pair<double, bool>> light;
  double seen = 0.011;
  for (int i = 0; i < seconds * 60; ++i) {
    const double now = i / 60.0;
    light.emplace_back(now, test.Show(now));
    while (seen < now) {
      double brightness = 40.0;
      for (const auto& [time, white] : light) {
        if (looks && time <= seen - latency) {
          brightness = white ? 200.0 : 40.0;
        }
      }
      test.See(seen, brightness + noise * random.Normal());
      seen += 1.0 / 30.0;
    }
  }
  return test.Result();
}

TEST(FlashTest, FindsTheLatencyThatTheDoubleHas) {
  for (const double latency : {0.02, 0.045, 0.1, 0.25}) {
    const auto result = Measure(latency, 8.0, 20.0);
    ASSERT_TRUE(result) << latency;
    EXPECT_NEAR(result->latency_ms, 1000.0 * latency, 9.0);
    EXPECT_GT(result->agreement, 0.9);
  }
}

TEST(FlashTest, SaysNothingWhereTheCameraDoesNotSeeTheDisplay) {
  EXPECT_FALSE(Measure(0.05, 8.0, 20.0, false));
  EXPECT_FALSE(Measure(0.05, 8.0, 1.0)) << "too short";
  EXPECT_FALSE(FlashTest().Result());
}

}  // namespace
}  // namespace lararium::player
