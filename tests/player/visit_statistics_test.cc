#include "player/kiosk/visit_statistics.h"

#include <gmock/gmock.h>

#include <fstream>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::HasSubstr;

class VisitStatisticsTest : public ::testing::Test {
 protected:
  VisitStatistics Load() { return LoadVisitStatistics(folder_.path(), *log_); }
  void Write(const std::string& text) {
    std::ofstream(folder_ / "statistics.json", std::ios::trunc) << text;
  }

  test::TemporaryFolder folder_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
};

TEST_F(VisitStatisticsTest, ComeBackAsTheyWereSaved) {
  EXPECT_TRUE(Load().days().empty()) << "none yet";
  VisitStatistics statistics;
  statistics.Day("2026-11-23") = {"2026-11-23", 12, 3600.0, 7, 3500.0, 3400.0, 4, 1};
  statistics.Day("2026-11-22").visitors = 3;
  ASSERT_TRUE(SaveVisitStatistics(folder_.path(), statistics).ok());
  EXPECT_EQ(Load(), statistics);
  EXPECT_EQ(Load().days().front().day, "2026-11-22") << "in their order";
}

TEST_F(VisitStatisticsTest, WhatCannotBeReadIsSetAside) {
  for (const char* text :
       {"", "{", "[]", R"({"schema":1})", R"({"schema":2,"days":[]})", R"({"schema":1,"days":{}})",
        R"({"schema":1,"days":[{"day":"yesterday"}]})",
        R"({"schema":1,"days":[{"day":"2026-11-23","visitors":-1}]})", "\xff\xfe"}) {
    std::filesystem::remove(folder_ / "statistics.json.damaged");
    Write(text);
    EXPECT_TRUE(Load().days().empty()) << text;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "statistics.json")) << text;
    EXPECT_EQ(*ReadText(folder_ / "statistics.json.damaged"), text);
  }
}

TEST_F(VisitStatisticsTest, AreBounded) {
  VisitStatistics statistics;
  for (int year = 1000; year < 2500; ++year) {
    statistics.Day(std::to_string(year) + "-01-01").visitors = year;
  }
  EXPECT_EQ(statistics.days().size(), VisitStatistics::kMostDays);
  EXPECT_EQ(statistics.days().front().day, "2100-01-01");
  statistics.Day("0999-01-01").visitors = 5;  // the clock was set back
  EXPECT_EQ(statistics.days().size(), VisitStatistics::kMostDays);
  EXPECT_EQ(statistics.days().front().visitors, 5);
  ASSERT_TRUE(SaveVisitStatistics(folder_.path(), statistics).ok());
  EXPECT_EQ(Load(), statistics) << "the largest file is still read";
}

TEST_F(VisitStatisticsTest, AreATableOfOneLineForEachDay) {
  VisitStatistics statistics;
  statistics.Day("2026-11-23") = {"2026-11-23", 12, 90.0, 7, 100.0, 50.0, 4, 1};
  statistics.Day("2026-11-24").visitors = 0;
  EXPECT_EQ(statistics.ToCsv(),
            "day,visitors,minutes_played,seen_to_the_end,share_tracked,losses,restarts\r\n"
            "2026-11-23,12,1.5,7,0.500,4,1\r\n"
            "2026-11-24,0,0.0,0,,0,0\r\n");
}

TEST_F(VisitStatisticsTest, SayNothingOfTheTimeOfDay) {
  EXPECT_EQ(Today().size(), 10u);
  EXPECT_THAT(Today(), HasSubstr("-"));
  EXPECT_FALSE(SaveVisitStatistics("/proc/nowhere", {}).ok());
}

// Ten frames per second with a visitor who moves in each.
class VisitCounterTest : public ::testing::Test {
 protected:
  void Watch(double seconds, bool moves, bool tracked = true, bool people_went = false) {
    for (int i = 0; i < seconds * 10; ++i) {
      moment_.now += 0.1;
      moment_.drama_time += 0.1;
      moment_.tracked = tracked;
      moment_.people_went = people_went;
      if (moves) {
        moment_.last_sign = moment_.now;
      }
      counter_.Count(moment_, day_);
    }
  }
  void Come() {
    moment_.noticed = true;
    moment_.last_sign = moment_.now;
    moment_.drama_time = 0.0;
  }
  void Leave() { moment_.noticed = false; }

  VisitCounter::Moment moment_ = {.now = 100.0, .story_length = 60.0};
  VisitCounter counter_;
  DayCounts day_;
};

TEST_F(VisitCounterTest, AHeadsetOnItsStandIsNoVisitor) {
  Watch(100.0, false);
  EXPECT_EQ(day_, DayCounts());
}

TEST_F(VisitCounterTest, WhoSeesTheStoryToItsEndIsCountedOnce) {
  Come();
  Watch(70.0, true);
  Watch(45.0, false);
  Leave();
  Watch(30.0, false);
  EXPECT_EQ(day_.visitors, 1);
  EXPECT_EQ(day_.completed, 1);
  EXPECT_NEAR(day_.played_seconds, 70.0, 0.3) << "without what it lay there before it was known";
  EXPECT_NEAR(day_.seen_seconds, 70.0, 0.3);
  EXPECT_NEAR(day_.tracked_seconds, 70.0, 0.3);
  Come();
  Watch(30.0, true);
  EXPECT_EQ(day_.visitors, 2);
  EXPECT_EQ(day_.completed, 1) << "left before the end";
}

TEST_F(VisitCounterTest, LossesCountWhileSomebodyIsThere) {
  Come();
  Watch(10.0, true);
  Watch(1.0, true, false, false);
  Watch(4.0, true, false, true);
  Watch(5.0, true);
  EXPECT_EQ(day_.losses, 1);
  EXPECT_NEAR(day_.seen_seconds, 20.0, 0.3);
  EXPECT_NEAR(day_.tracked_seconds, 15.0, 0.3);
  Watch(10.0, false, false, true);
  Leave();
  Watch(10.0, false, false, true);
  EXPECT_EQ(day_.losses, 1) << "it was laid down";
}

TEST_F(VisitCounterTest, GoingToAnotherMomentIsNotSeeingTheEnd) {
  Come();
  Watch(10.0, true);
  moment_.drama_time = 200.0;
  Watch(10.0, true);
  EXPECT_EQ(day_.completed, 0);
}

TEST_F(VisitCounterTest, WhoWasThereBeforeARestartIsNotANewVisitor) {
  counter_ = VisitCounter(true);
  Come();
  Watch(10.0, true);
  EXPECT_EQ(day_.visitors, 0);
  Leave();
  Watch(1.0, false);
  Come();
  Watch(10.0, true);
  EXPECT_EQ(day_.visitors, 1);
}

}  // namespace
}  // namespace lararium::player
