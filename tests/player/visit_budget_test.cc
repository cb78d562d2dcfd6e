#include "player/kiosk/visit_budget.h"

#include <gtest/gtest.h>

namespace lararium::player {
namespace {

constexpr VisitOptions kOneMinute = {.longest = 60.0, .fade = 2.0, .farewell = 15.0};

TEST(VisitBudget, WithoutOneAVisitGoesOn) {
  VisitBudget budget;
  for (double now = 0.0; now < 1e5; now += 100.0) {
    EXPECT_FALSE(budget.Update(now, true));
    EXPECT_EQ(budget.shown(), 1.0f);
    EXPECT_EQ(budget.farewell(), 0.0f);
  }
}

TEST(VisitBudget, BeginsWithWhoIsNoticedFirst) {
  VisitBudget budget(kOneMinute);
  for (double now = 0.0; now < 500.0; now += 1.0) {
    budget.Update(now, false);
  }
  budget.Update(500.0, true);
  budget.Update(559.0, true);
  EXPECT_FALSE(budget.over());
  budget.Update(560.0, true);
  EXPECT_TRUE(budget.over());
}

TEST(VisitBudget, PeopleGoAndTheFarewellComesAndIsReadForAWhile) {
  VisitBudget budget(kOneMinute);
  budget.Begin(100.0);
  budget.Update(160.0, true);
  EXPECT_EQ(budget.shown(), 1.0f);
  budget.Update(161.0, true);
  EXPECT_FLOAT_EQ(budget.shown(), 0.5f);
  EXPECT_FLOAT_EQ(budget.farewell(), 0.5f);
  EXPECT_FALSE(budget.Update(176.9, true));
  EXPECT_EQ(budget.shown(), 0.0f);
  EXPECT_EQ(budget.farewell(), 1.0f);
  EXPECT_TRUE(budget.Update(177.1, true));
  EXPECT_FALSE(budget.Update(178.0, true)) << "told already";
  EXPECT_EQ(budget.farewell(), 1.0f) << "until the next visit";
}

TEST(VisitBudget, TheNextVisitHasItsWholeTime) {
  VisitBudget budget(kOneMinute);
  budget.Begin(0.0);
  budget.Update(60.0, true);
  budget.Update(100.0, true);
  budget.Begin(130.0);
  EXPECT_FALSE(budget.over());
  budget.Update(189.0, true);
  EXPECT_EQ(budget.shown(), 1.0f);
  budget.Update(190.0, true);
  EXPECT_TRUE(budget.over());
}

TEST(VisitBudget, AHeadsetThatLiesOnItsStandUsesNobodysTime) {
  VisitBudget budget(kOneMinute);
  budget.Begin(0.0);
  budget.Update(1000.0, false);
  EXPECT_FALSE(budget.over());
}

}  // namespace
}  // namespace lararium::player
