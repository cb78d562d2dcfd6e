#include "player/kiosk/visitor_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "shared/core/random.h"

namespace lararium::player {
namespace {

using geometry::Rigid3;
using Event = VisitorWatch::Event;

Rigid3 Still(double) { return {Eigen::Quaterniond::Identity(), {0.0, 0.0, 2.0}}; }

// The pose of a visitor who looks around calmly.
Rigid3 Watching(double time) {
  return {geometry::RotationFromVector(Eigen::Vector3d(0.0, 0.3 * std::sin(0.8 * time), 0.0)),
          {0.1 * std::sin(0.5 * time), 0.0, 2.0}};
}

// Updates watch for a number of seconds. Returns the events with their times since begin.
std::vector<std::pair<double, Event>> Play(VisitorWatch& watch,
                                           double begin,
                                           double seconds,
                                           const std::function<std::optional<Rigid3>(double)>& at) {
  std::vector<std::pair<double, Event>> events;
  for (int i = 0; i < seconds * 30; ++i) {
    const double time = begin + i / 30.0;
    const Event event = watch.Update(time, at(time));
    if (event != Event::kNone) {
      events.emplace_back(time - begin, event);
    }
  }
  return events;
}

TEST(VisitorWatch, AtTheBeginningNobodyIsNoticedUntilTheyMove) {
  VisitorWatch watch;
  Play(watch, 0.0, 10.0, Still);
  EXPECT_TRUE(watch.present());
  EXPECT_FALSE(watch.noticed());
  Play(watch, 10.0, 5.0, Watching);
  EXPECT_TRUE(watch.noticed());
  EXPECT_NEAR(watch.last_sign(), 15.0, 0.5);
  Play(watch, 15.0, 60.0, Still);
  EXPECT_FALSE(watch.noticed());
}

TEST(VisitorWatch, WhoLooksAboutIsThereForHours) {
  VisitorWatch watch;
  EXPECT_TRUE(Play(watch, 0.0, 3600.0, Watching).empty());
  EXPECT_TRUE(watch.present());
}

TEST(VisitorWatch, AHeadsetAtRestIsLeftAndTakenUpWithinASecond) {
  VisitorWatch watch;
  Play(watch, 0.0, 30.0, Watching);
  auto events = Play(watch, 30.0, 600.0, Still);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].second, Event::kLeft);
  EXPECT_NEAR(events[0].first, 45.0, 2.0);
  events = Play(watch, 630.0, 30.0, Watching);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].second, Event::kCame);
  EXPECT_LT(events[0].first, 1.0);
}

TEST(VisitorWatch, WhatTrembleThereIsWakesNobody) {
  VisitorWatch watch;
  Random random(3);
  Play(watch, 0.0, 100.0, Still);
  ASSERT_FALSE(watch.present());
  const auto events = Play(watch, 100.0, 600.0, [&](double) {
    return Rigid3{geometry::RotationFromVector(
                      Eigen::Vector3d{random.Normal(), random.Normal(), 0.0} * 0.0008),
                  {0.0005 * random.Normal(), 0.0, 2.0}};
  });
  EXPECT_TRUE(events.empty());
}

TEST(VisitorWatch, APassingKnockDoesNotBeginTheShow) {
  VisitorWatch watch;
  Play(watch, 0.0, 100.0, Still);
  ASSERT_FALSE(watch.present());
  const auto events = Play(watch, 100.0, 60.0, [](double time) {
    const double since = time - 110.0;
    return Rigid3{Eigen::Quaterniond::Identity(),
                  {since > 0.0 && since < 0.2 ? 0.03 : 0.0, 0.0, 2.0}};
  });
  EXPECT_TRUE(events.empty());
}

TEST(VisitorWatch, WithoutAPoseNobodyIsThereAfterAWhile) {
  VisitorWatch watch;
  Play(watch, 0.0, 10.0, Watching);
  const auto events = Play(watch, 10.0, 100.0, [](double) { return std::nullopt; });
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].second, Event::kLeft);
}

TEST(VisitorWatch, AButtonIsASignOfSomebody) {
  VisitorWatch watch;
  Play(watch, 0.0, 40.0, Still);
  EXPECT_EQ(watch.Touch(40.0), Event::kNone);
  EXPECT_TRUE(Play(watch, 40.0, 40.0, Still).empty());
  Play(watch, 80.0, 20.0, Still);
  EXPECT_FALSE(watch.present());
  EXPECT_EQ(watch.Touch(100.0), Event::kCame);
}

TEST(VisitorWatch, WhoGoesOnMovingAfterAnEndedVisitIsTheNext) {
  VisitorWatch watch;
  Play(watch, 0.0, 30.0, Watching);
  watch.Leave();
  EXPECT_FALSE(watch.noticed());
  const auto events = Play(watch, 30.0, 2.0, Watching);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events.front().second, Event::kCame);
  EXPECT_LT(events.front().first, 1.0);
}

}  // namespace
}  // namespace lararium::player
