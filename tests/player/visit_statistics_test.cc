#include "player/kiosk/visit_statistics.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

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
  statistics.Day("2026-11-23").details =
      VisitDetails{.lengths = {2, 0, 10},
                   .ended = {1, 11},
                   .languages = {{"it", 12}},
                   .captions = {{"off", 12}},
                   .lost = {{{"bar", -2, 3}, 4}, {{"bar", 0, 3}, 1}}};
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

TEST_F(VisitStatisticsTest, OfAPlayerWithoutDetailsAreStillRead) {
  Write(R"({"schema": 1, "days": [{"day": "2026-11-23", "visitors": 41, "played_seconds": 9120,
      "completed": 30, "seen_seconds": 9011, "tracked_seconds": 8702, "losses": 17,
      "restarts": 0}]})");
  ASSERT_EQ(Load().days().size(), 1u);
  EXPECT_EQ(Load().days().front().visitors, 41);
  EXPECT_TRUE(Load().days().front().details->empty());
}

TEST_F(VisitStatisticsTest, DamagedDetailsAreSetAside) {
  const std::string day = R"({"schema":1,"days":[{"day":"2026-11-23","visitors":1,"completed":1,
      "losses":0,"restarts":0,"played_seconds":1,"seen_seconds":1,"tracked_seconds":1,)";
  for (const char* field :
       {R"("lengths":[-1])", R"("lengths":[1,2,3,4,5,6,7])", R"("ended":{})", R"("languages":[])",
        R"("languages":{"it":"many"})", R"("lost":[[0,0,1]])",
        R"("lost":[{"place":"bar","x":1e9,"z":0,"visits":1}])"}) {
    Write(day + field + "}]}");
    EXPECT_TRUE(Load().days().empty()) << field;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "statistics.json.damaged")) << field;
  }
}

// The most that there can be in a day.
VisitDetails FullDetails() {
  VisitDetails details = {.lengths = std::vector<int64_t>(6, 1000),
                          .ended = std::vector<int64_t>(VisitDetails::kMostMinutes, 1000)};
  for (int i = 0; i < 1000; ++i) {
    const std::string name = std::to_string(1000 + i);
    AddVisit({.language = name, .captions = name, .lost = {{std::string(64, 'b'), i, -i}}},
             details);
  }
  for (auto& [cell, visits] : details.lost) {
    visits = 1000;
  }
  return details;
}

TEST_F(VisitStatisticsTest, OfOldDaysHaveNoDetails) {
  VisitStatistics statistics;
  for (int i = 0; i < 300; ++i) {
    statistics.Day(std::to_string(1000 + i) + "-01-01").details = FullDetails();
  }
  const auto detailed = std::count_if(statistics.days().begin(), statistics.days().end(),
                                      [](const DayCounts& d) { return !d.details->empty(); });
  EXPECT_EQ(detailed, static_cast<std::ptrdiff_t>(VisitStatistics::kMostDetailedDays));
  EXPECT_FALSE(statistics.days().back().details->empty());
  ASSERT_TRUE(SaveVisitStatistics(folder_.path(), statistics).ok());
  EXPECT_EQ(Load(), statistics) << "the largest file is still read";
}

TEST_F(VisitStatisticsTest, OfADayWithFewVisitorsOnlyTheirNumberIsPublished) {
  VisitStatistics statistics;
  statistics.Day("2026-11-23") = {"2026-11-23", 9, 90.0, 7, 100.0, 50.0, 4, 1};
  statistics.Day("2026-11-23").details = VisitDetails{.lengths = {9}};
  statistics.Day("2026-11-24") = {"2026-11-24", 10, 90.0, 7, 100.0, 50.0, 4, 1};
  statistics.Day("2026-11-24").details = VisitDetails{.ended = {9, 10}};
  const auto published = ParseVisitStatistics(PublishedStatistics(statistics), "published");
  ASSERT_TRUE(published.ok()) << published.message();
  VisitStatistics expected;
  expected.Day("2026-11-23") = {.day = "2026-11-23", .visitors = 9, .restarts = 1};
  expected.Day("2026-11-24") = {"2026-11-24", 10, 90.0, 7, 100.0, 50.0, 4, 1};
  expected.Day("2026-11-24").details = VisitDetails{.ended = {0, 10}};
  EXPECT_EQ(*published, expected);
}

TEST_F(VisitStatisticsTest, ArePublishedForAMonthAndFitIntoAMessage) {
  VisitStatistics statistics;
  EXPECT_EQ(PublishedStatistics(statistics), R"({"days":[],"schema":1})");
  for (int i = 0; i < 100; ++i) {
    statistics.Day(std::to_string(2000 + i) + "-01-01").visitors = 50;
  }
  const auto month = ParseVisitStatistics(PublishedStatistics(statistics), "published");
  ASSERT_EQ(month->days().size(), kMostPublishedDays);
  EXPECT_EQ(month->days().back().day, "2099-01-01");
  for (int i = 60; i < 100; ++i) {
    statistics.Day(std::to_string(2000 + i) + "-01-01").details = FullDetails();
  }
  const std::string text = PublishedStatistics(statistics);
  EXPECT_LE(text.size(), kMostPublishedBytes);
  const auto fitting = ParseVisitStatistics(text, "published");
  ASSERT_FALSE(fitting->days().empty());
  EXPECT_EQ(fitting->days().back().day, "2099-01-01");
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
  void Leave() {
    moment_.noticed = false;
    Watch(0.1, false);
  }

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

TEST_F(VisitCounterTest, AVisitHasItsLengthItsEndAndItsLanguageWhenItIsOver) {
  moment_.language = "la";
  Come();
  Watch(40.0, true);
  moment_.language = "it";
  Watch(40.0, true);
  EXPECT_TRUE(day_.details->empty()) << "goes on";
  Watch(45.0, false);
  Leave();
  EXPECT_THAT(day_.details->lengths, ElementsAre(0, 1)) << "80 s";
  EXPECT_THAT(day_.details->ended, ElementsAre(0, 1)) << "without the time on the stand";
  EXPECT_THAT(day_.details->languages, ElementsAre(Pair("it", 1)));
  EXPECT_TRUE(day_.details->captions.empty());
}

TEST_F(VisitCounterTest, ASquareOfTheFloorCountsOnceForAVisitThatLostTrackingThere) {
  moment_.place = "bar";
  Come();
  moment_.at = {1.5, -0.5};
  for (int i = 0; i < 3; ++i) {
    Watch(5.0, true);
    moment_.at = {9.0, 9.0};  // A position without tracking does not count.
    Watch(3.0, true, false, true);
    moment_.at = {1.9, -0.1};
  }
  moment_.at = {2.0, 0.0};
  Watch(5.0, true);
  Watch(3.0, true, false, true);
  Watch(5.0, true);
  moment_.at = {4.0, 0.0};
  Watch(0.1, true);
  Watch(45.0, false, false, true);
  Leave();
  EXPECT_EQ(day_.losses, 4);
  EXPECT_THAT(day_.details->lost,
              ElementsAre(Pair(FloorCell{"bar", 1, -1}, 1), Pair(FloorCell{"bar", 2, 0}, 1)))
      << "not where the headset was laid down";
}

TEST_F(VisitCounterTest, AVisitWhoseBeginningWasNotSeenHasNoDetails) {
  counter_ = VisitCounter(true);
  Come();
  Watch(10.0, true);
  Leave();
  EXPECT_TRUE(day_.details->empty());
  Come();
  Watch(10.0, true);
  Leave();
  EXPECT_THAT(day_.details->lengths, ElementsAre(1));
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
