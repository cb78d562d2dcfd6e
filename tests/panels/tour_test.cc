#include "editor/panels/dialogs/tour.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lararium::panels {
namespace {

// The facts after each step of the tour was done; each step changes one fact.
std::vector<TourFacts> DoneStepByStep() {
  TourFacts facts;
  std::vector<TourFacts> steps;
  const auto then = [&](auto&& change) {
    change(facts);
    steps.push_back(facts);
  };
  then([](TourFacts& f) { f.trained = f.picture = true; });
  then([](TourFacts& f) { f.playing = true; });
  then([](TourFacts& f) { f.report = true; });
  then([](TourFacts& f) { f.matches = true; });
  then([](TourFacts& f) { f.around = true; });
  then([](TourFacts& f) { f.stage = "moved", f.dirty = true; });
  then([](TourFacts& f) { f.stage = "", f.can_redo = true; });
  then([](TourFacts& f) { f.person = true; });
  then([](TourFacts& f) { f.light = "turned", f.can_redo = false; });
  then([](TourFacts& f) { ++f.script; });
  then([](TourFacts& f) { f.checked = true; });
  then([](TourFacts& f) { f.dirty = false; });
  then([](TourFacts& f) { f.exported = true; });
  return steps;
}

TEST(Tour, GoesOnWhenAStepIsDoneAndNotBefore) {
  const std::vector<TourFacts> steps = DoneStepByStep();
  ASSERT_EQ(steps.size(), TourSteps().size());
  Tour tour;
  TourFacts before;
  tour.Begin(before);
  for (size_t i = 0; i < steps.size(); ++i) {
    ASSERT_EQ(tour.number(), i);
    for (int frame = 0; frame < 3; ++frame) {
      tour.Update(before);
    }
    EXPECT_EQ(tour.number(), i) << "went on although nothing was done: " << tour.step()->title;
    EXPECT_FALSE(tour.finished());
    tour.Update(steps[i]);
    before = steps[i];
  }
  EXPECT_TRUE(tour.finished());
}

TEST(Tour, WhatWasEditedBeforeAStepDoesNotCountForIt) {
  Tour tour;
  TourFacts now;
  tour.Begin(now);
  while (std::string(tour.step()->title) != "Move the stage") {
    tour.Skip(now);
  }
  tour.End();
  now.stage = "moved long ago";
  tour.Begin(now);
  while (std::string(tour.step()->title) != "Move the stage") {
    tour.Skip(now);
  }
  tour.Update(now);
  EXPECT_STREQ(tour.step()->title, "Move the stage");
  now.stage = "moved now";
  tour.Update(now);
  EXPECT_STREQ(tour.step()->title, "Undo");
}

TEST(Tour, ADramaThatPlaysAlreadyIsToBePaused) {
  Tour tour;
  TourFacts now;
  now.trained = now.picture = now.playing = true;
  tour.Begin(now);
  tour.Update(now);
  EXPECT_STREQ(tour.step()->title, "Watch the drama");
  tour.Update(now);
  EXPECT_STREQ(tour.step()->title, "Watch the drama");
  now.playing = false;
  tour.Update(now);
  EXPECT_STREQ(tour.step()->title, "See how the place was learned");
}

TEST(Tour, CanBeSkippedThroughAndEnded) {
  Tour tour;
  EXPECT_EQ(tour.step(), nullptr);
  tour.Update({});
  tour.Skip({});
  EXPECT_EQ(tour.step(), nullptr);
  tour.Begin({});
  for (size_t i = 0; i < TourSteps().size(); ++i) {
    EXPECT_FALSE(tour.finished());
    tour.Skip({});
  }
  EXPECT_TRUE(tour.finished());
  tour.End();
  EXPECT_EQ(tour.step(), nullptr);
  EXPECT_FALSE(tour.finished());
}

}  // namespace
}  // namespace lararium::panels
