#include "player/staff/staff_state.h"

#include <gtest/gtest.h>

namespace lararium::player {
namespace {

TEST(TrackingTally, SharesAreOfAllFramesAndOfTheLastMinute) {
  TrackingTally tally;
  EXPECT_EQ(tally.since_start(), 0.0);
  EXPECT_EQ(tally.last_minute(), 0.0);
  for (int i = 0; i < 120 * 10; ++i) {  // two minutes with ten frames per second
    const double now = 1000.0 + i / 10.0;
    tally.Add(now, i >= 60 * 10, i > 100 && i < 60 * 10);
  }
  EXPECT_DOUBLE_EQ(tally.since_start(), 0.5);
  EXPECT_DOUBLE_EQ(tally.last_minute(), 1.0);
  EXPECT_EQ(tally.losses(), 1);
  EXPECT_NEAR(tally.frames_per_second(), 10.0, 0.6);
}

TEST(TrackingTally, WhatIsOlderThanAMinuteDoesNotCountAfterAPauseEither) {
  TrackingTally tally;
  tally.Add(1.0, true, false);
  tally.Add(500.0, false, false);
  EXPECT_EQ(tally.last_minute(), 0.0);
}

TEST(StaffJson, IsJsonWhateverItHolds) {
  StaffState state;
  state.title = "a \"b\" \xff</script>";
  StaffMachine machine;
  machine.battery = Battery{0.5, true};
  for (int i = 0; i < 12; ++i) {
    machine.warnings.push_back({std::string(240, '\xfe'), true, {}, 1});
  }
  const std::string text = StaffJson(state, machine);
  const auto json = ParseJson(text, "state");
  ASSERT_TRUE(json.ok()) << json.message();
  EXPECT_EQ((*json)["power"]["charging"], true);
  EXPECT_EQ((*json)["power"]["celsius"], Json());
  EXPECT_LT(text.size(), 50'000u);
}

TEST(LastState, HoldsWhatThePlayerSaidAndWhetherItAnswers) {
  LastState last;
  const auto before = ParseJson(last.ToJson({{"name", "tablet-01"}}), "state");
  ASSERT_TRUE(before.ok()) << before.message();
  EXPECT_EQ((*before)["schema"], 1);
  EXPECT_EQ((*before)["name"], "tablet-01");
  EXPECT_EQ((*before)["answers"], false);
  EXPECT_EQ((*before)["player"], Json());
  StaffState state;
  state.show = "0123456789ab";
  state.position = {1.0, 1.6, -2.5};
  last.Set(StaffJson(state, {}));
  const auto after = ParseJson(last.ToJson(Json::object()), "state");
  ASSERT_TRUE(after.ok()) << after.message();
  EXPECT_EQ((*after)["answers"], true);
  EXPECT_LT((*after)["silent_seconds"], 3.0);
  EXPECT_EQ((*after)["player"]["show"], "0123456789ab");
  EXPECT_EQ((*after)["player"]["position"][2], -2.5);
}

TEST(RecentWarnings, KeepsTheLastAndCountsWhatIsSaidAgain) {
  const auto log = MakeSilentLog();
  const auto recent = RecentWarnings::Of(*log);
  EXPECT_EQ(RecentWarnings::Of(*log), recent);
  log->Info("nothing to worry about");
  for (int i = 0; i < 20; ++i) {
    log->Warn("warning {}", i);
  }
  log->Error("bad\nsecond line");
  log->Error("bad");
  const auto entries = recent->Entries();
  ASSERT_EQ(entries.size(), RecentWarnings::kMostEntries);
  EXPECT_EQ(entries.front().text, "warning 9");
  EXPECT_EQ(entries.back().text, "bad");
  EXPECT_EQ(entries.back().times, 2);
  EXPECT_TRUE(entries.back().error);
}

TEST(RecentWarnings, CutsLongOnesBetweenCharacters) {
  const auto log = MakeSilentLog();
  const auto recent = RecentWarnings::Of(*log);
  std::string text = "a";
  for (int i = 0; i < 300; ++i) {
    text += "\xc3\xa9";
  }
  log->Warn("{}", text);
  EXPECT_EQ(recent->Entries().front().text, text.substr(0, 239));
}

}  // namespace
}  // namespace lararium::player
