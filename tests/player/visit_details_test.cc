#include "player/kiosk/visit_details.h"

#include <gmock/gmock.h>

namespace lararium::player {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(VisitDetails, AVisitCountsOnceInEachTable) {
  VisitDetails details;
  const FloorCell corner = {"bar", -3, 2};
  AddVisit({.seconds = 59.0, .drama_seconds = 61.0, .language = "it", .lost = {corner}}, details);
  AddVisit({.seconds = 60.0, .drama_seconds = 1e9, .language = "it", .captions = "off"}, details);
  AddVisit({.seconds = 1e6, .drama_seconds = -1.0, .language = "la", .lost = {corner}}, details);
  EXPECT_THAT(details.lengths, ElementsAre(1, 1, 0, 0, 0, 1));
  EXPECT_EQ(details.ended.size(), VisitDetails::kMostMinutes);
  EXPECT_EQ(details.ended.front(), 1);
  EXPECT_EQ(details.ended[1], 1);
  EXPECT_EQ(details.ended.back(), 1);
  EXPECT_THAT(details.languages, ElementsAre(Pair("it", 2), Pair("la", 1)));
  EXPECT_THAT(details.captions, ElementsAre(Pair("off", 1)));
  EXPECT_THAT(details.lost, ElementsAre(Pair(corner, 2)));
}

TEST(VisitDetails, AreBounded) {
  VisitDetails details;
  for (int i = 0; i < 1000; ++i) {
    AddVisit({.language = std::to_string(i), .lost = {{"bar", i, 0}}}, details);
  }
  EXPECT_EQ(details.languages.size(), VisitDetails::kMostLanguages);
  EXPECT_EQ(details.lost.size(), VisitDetails::kMostCells);
  AddVisit({.language = "0", .lost = {{"bar", 0, 0}}}, details);
  EXPECT_EQ(details.languages["0"], 2) << "known ones still count";
  EXPECT_EQ((details.lost[FloorCell{"bar", 0, 0}]), 2);
}

TEST(VisitDetails, NoCountOfFewerThanTenVisitsIsTold) {
  VisitDetails details = {.lengths = {9, 10, 300, 0, 1, 0},
                          .ended = {1, 10, 9},
                          .languages = {{"it", 30}, {"la", 12}, {"en", 9}, {"fr", 1}},
                          .lost = {{{"bar", 0, 0}, 9}, {{"bar", 1, 0}, 10}}};
  RemoveSmallCounts(details);
  EXPECT_THAT(details.lengths, ElementsAre(0, 10, 300));
  EXPECT_THAT(details.ended, ElementsAre(0, 10));
  EXPECT_THAT(details.languages, ElementsAre(Pair("it", 30), Pair("la", 12)));
  EXPECT_THAT(details.lost, ElementsAre(Pair(FloorCell{"bar", 1, 0}, 10)));
}

// 60 visits, of which 59 are told: the one that is missing would have a known length.
TEST(VisitDetails, ACountThatIsMissingCannotBeComputedFromTheNumberOfVisits) {
  VisitDetails details = {.lengths = {1, 11, 12, 10, 13, 13},
                          .languages = {{"it", 59}, {"la", 1}},
                          .captions = {{"it", 40}, {"en", 15}, {"off", 5}}};
  RemoveSmallCounts(details);
  EXPECT_THAT(details.lengths, ElementsAre(0, 11, 12, 0, 13, 13));
  EXPECT_THAT(details.languages, IsEmpty());
  EXPECT_THAT(details.captions, ElementsAre(Pair("it", 40)));
}

}  // namespace
}  // namespace lararium::player
