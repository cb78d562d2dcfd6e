#include "editor/panels/viewport/point_colours.h"

#include <gtest/gtest.h>

#include <vector>

#include "editor/panels/widgets/palette.h"

namespace lararium::panels {
namespace {

// One point for each error; point i has i + 2 views.
train::MapStatistics Statistics(std::vector<float> errors) {
  train::MapStatistics statistics;
  statistics.first_observation = {0};
  for (uint32_t i = 0; i < errors.size(); ++i) {
    statistics.first_observation.push_back(statistics.first_observation.back() + i + 2);
    statistics.point_session.push_back(static_cast<uint8_t>(i % 3));
    statistics.point_shades.push_back(static_cast<uint8_t>(i));
  }
  statistics.point_error_px = std::move(errors);
  return statistics;
}

TEST(RoundUp, GivesNumbersThatPeopleRead) {
  EXPECT_DOUBLE_EQ(RoundUp(0.43), 0.5);
  EXPECT_DOUBLE_EQ(RoundUp(0.5), 0.5);
  EXPECT_DOUBLE_EQ(RoundUp(5.1), 10.0);
  EXPECT_DOUBLE_EQ(RoundUp(1.0), 1.0);
  EXPECT_DOUBLE_EQ(RoundUp(13.0), 20.0);
}

TEST(ErrorRange, IsNotStretchedByAnOutlier) {
  std::vector<float> errors(100, 0.3f);
  errors[50] = 90.0f;
  errors[51] = -1.0f;
  EXPECT_DOUBLE_EQ(ErrorRange(Statistics(errors)).high, 0.5);
  EXPECT_DOUBLE_EQ(ErrorRange(Statistics(errors)).low, 0.0);
}

TEST(ErrorRange, IsNoPointOfAMapWithoutErrors) {
  EXPECT_GT(ErrorRange(Statistics({0.0f, 0.0f})).high, 0.0);
  EXPECT_GT(ErrorRange(Statistics({})).high, 0.0);
  EXPECT_GT(ViewRange(Statistics({})).high, ViewRange(Statistics({})).low);
}

TEST(PointColours, GrowLighterWithTheError) {
  const auto colours = ColoursOf(Statistics({0.1f, 0.2f, 0.4f}), PointColour::kError);
  EXPECT_LT(colours[0].g, colours[1].g);
  EXPECT_LT(colours[1].g, colours[2].g);
}

TEST(PointColours, TellAnErrorThatIsNotKnownFromNone) {
  const auto colours = ColoursOf(Statistics({0.0f, -1.0f}), PointColour::kError);
  EXPECT_NE(colours[0], colours[1]);
}

TEST(PointColours, OfSessionsAreThoseOfThePalette) {
  train::MapStatistics statistics = Statistics({0.0f, 0.0f, 0.0f});
  statistics.point_session = {0, 1, train::kNoSingleSession};
  const auto colours = ColoursOf(statistics, PointColour::kSessions);
  EXPECT_NEAR(colours[1].r, 255.0f * SessionColour(1).x, 0.51f);
  EXPECT_NEAR(colours[2].b, 255.0f * kSeveralColour.z, 0.51f);
  EXPECT_NE(colours[0], colours[1]);
}

TEST(PointColours, FollowOneAnotherInARound) {
  PointColour colour = PointColour::kPicture;
  for (int i = 0; i < kPointColours; ++i) {
    colour = After(colour);
    EXPECT_EQ(colour == PointColour::kPicture, i == kPointColours - 1);
  }
}

}  // namespace
}  // namespace lararium::panels
