#include "editor/check/walk_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace lararium::editor {
namespace {

using drama::TimelineItem;
using drama::TimelineText;
using testing::HasSubstr;

constexpr const char* kScript = R"(
track{actor = "keeper",
  speech = {{at = 1, line = "salve"}},
  walks = {
    {at = 0, from = {x = 0, z = 0, heading = 90}},
    {id = "there", at = 2, to = {x = 3, z = 0, heading = 180}},  -- to the counter
    {at = 20, to = {x = 0, z = 2}},
  },
}
track{actor = "guest", walks = {{at = 5, to = {x = 1, z = 1}}}}
)";

TimelineText Read(const std::string& script) {
  Result<TimelineText> text = TimelineText::Read(script, "drama.lua");
  CHECK(text.ok());
  return *std::move(text);
}

// The floor is 10 m by 10 m; a wall at x = 1.5 reaches from z = -1 to 5.
std::shared_ptr<const stage::Navigation> Floor() {
  stage::NavigationOptions options;
  options.floor = {{-5.0f, -5.0f}, {5.0f, -5.0f}, {5.0f, 5.0f}, {-5.0f, 5.0f}};
  const std::vector<stage::BlockedArea> wall = {
      {{{1.4f, -1.0f}, {1.6f, -1.0f}, {1.6f, 5.0f}, {1.4f, 5.0f}}, false}};
  Result<std::unique_ptr<stage::Navigation>> floor = stage::Navigation::Create(options, {}, wall);
  CHECK(floor.ok());
  return std::move(*floor);
}

// A run of kScript in which the keeper walks in a curve.
DramaRun Played() {
  DramaRun run;
  run.floor = Floor();
  run.trails = {{"keeper",
                 {{0.0, {0.0f, 0.0f}, 1.5f, true},
                  {2.0, {0.0f, 0.0f}, 1.5f, false},
                  {4.0, {1.5f, -2.0f}, 1.5f, false},
                  {6.0, {3.0f, 0.0f}, 3.1f, false}}}};
  drama::TaskRecord walk;
  walk.actor = "keeper";
  walk.action = "walk_to";
  walk.from_timeline = true;
  walk.began = 2.0;
  walk.ended = 6.0;
  run.tasks = {walk};
  return run;
}

TEST(WalkPaths, WhatWasPlayedIsTheWayThatWasWalked) {
  const TimelineText text = Read(kScript);
  const DramaRun run = Played();
  const std::vector<WalkPath> walks = FindWalkPaths(&text, &run, true, "keeper");
  ASSERT_EQ(walks.size(), 3u);
  const WalkPath& walk = walks[1];
  EXPECT_EQ(walk.task, 0u);
  EXPECT_EQ(walk.item, (TimelineItem{1, 1}));
  ASSERT_EQ(walk.way.size(), 3u);
  EXPECT_EQ(walk.way[1].place, glm::vec2(1.5f, -2.0f));
  EXPECT_EQ(walk.problem, "");
  EXPECT_NEAR(*walk.to->heading, 3.1416f, 1e-3f);
}

TEST(WalkPaths, WhoIsOnlyPlacedHasABeginningAndNoWay) {
  const TimelineText text = Read(kScript);
  const std::vector<WalkPath> walks = FindWalkPaths(&text, nullptr, false, "keeper");
  EXPECT_TRUE(walks[0].from.has_value());
  EXPECT_FALSE(walks[0].to.has_value());
  EXPECT_TRUE(walks[0].way.empty());
}

TEST(WalkPaths, WhatWasNotPlayedYetIsPlannedAroundWhatIsInTheWay) {
  const TimelineText text = Read(kScript);
  DramaRun run = Played();
  run.tasks.clear();
  const WalkPath walk = FindWalkPaths(&text, &run, true, "keeper")[1];
  EXPECT_FALSE(walk.task.has_value());
  EXPECT_EQ(walk.problem, "");
  ASSERT_GE(walk.way.size(), 3u);
  EXPECT_EQ(walk.way.front().place, glm::vec2(0.0f, 0.0f));
  EXPECT_EQ(walk.way.back().place, glm::vec2(3.0f, 0.0f));
  for (size_t i = 1; i < walk.way.size(); ++i) {
    const glm::vec2 a = walk.way[i - 1].place;
    const glm::vec2 b = walk.way[i].place;
    if ((a.x - 1.5f) * (b.x - 1.5f) < 0.0f) {
      const float share = (1.5f - a.x) / (b.x - a.x);
      EXPECT_LT(a.y + share * (b.y - a.y), -1.0f);  // Beyond the end of the wall.
    }
  }
}

TEST(WalkPaths, AWalkThatWasSentElsewhereSinceIsPlannedAnew) {
  TimelineText text = Read(kScript);
  const DramaRun run = Played();
  ASSERT_TRUE(SetWalkPlace(text, {1, 1}, kWalkTo, {-3.0f, 1.0f}).ok());
  const WalkPath walk = FindWalkPaths(&text, &run, false, "keeper")[1];
  EXPECT_FALSE(walk.task.has_value());
  EXPECT_EQ(walk.way.back().place, glm::vec2(-3.0f, 1.0f));
  // Another edit does not change the recorded walk.
  const TimelineText other = Read(std::string(kScript) + "-- more\n");
  EXPECT_TRUE(FindWalkPaths(&other, &run, false, "keeper")[1].task.has_value());
}

TEST(WalkPaths, WhereNoWayLeadsThereItSaysSo) {
  const TimelineText text = Read(kScript);
  const DramaRun run = Played();
  WalkPath walk = FindWalkPaths(&text, &run, true, "keeper")[1];
  PlanWalk(&run, {9.0f, 0.0f}, walk);
  EXPECT_THAT(walk.problem, HasSubstr("No way leads there"));
  EXPECT_LT(walk.way.back().place.x, 5.0f);
}

TEST(WalkPaths, WhyAPlayedWalkFailedIsTold) {
  const TimelineText text = Read(kScript);
  DramaRun run = Played();
  run.tasks[0].failed = true;
  run.tasks[0].message = "'keeper' cannot get there";
  EXPECT_EQ(FindWalkPaths(&text, &run, true, "keeper")[1].problem, "'keeper' cannot get there");
}

TEST(WalkPaths, WalksOfTheScriptAreThereToo) {
  DramaRun run = Played();
  run.tasks[0].from_timeline = false;
  const std::vector<WalkPath> walks = FindWalkPaths(nullptr, &run, true, "keeper");
  ASSERT_EQ(walks.size(), 1u);
  EXPECT_FALSE(walks[0].item.has_value());
  EXPECT_EQ(walks[0].way.size(), 3u);
}

TEST(SetWalkPlace, ChangesThePlaceAndLeavesTheRest) {
  TimelineText text = Read(kScript);
  ASSERT_TRUE(SetWalkPlace(text, {1, 1}, kWalkTo, {1.23456f, -0.0001f}).ok());
  EXPECT_THAT(text.text(), HasSubstr("{id = \"there\", at = 2, to = {heading = 180, x = 1.235, "
                                     "z = 0"));
  EXPECT_THAT(text.text(), HasSubstr("-- to the counter"));
  const auto point = WalkPointOf(text, {1, 1}, kWalkTo);
  EXPECT_NEAR(point->place.x, 1.235f, 1e-6f);
  EXPECT_NEAR(*point->heading, 3.1416f, 1e-3f);
}

TEST(SetWalkPlace, RefusesWhatIsNotWrittenOut) {
  TimelineText text = Read(kScript);
  EXPECT_THAT(SetWalkPlace(text, {1, 1}, kWalkFrom, {1.0f, 1.0f}).message(), HasSubstr("from"));
  EXPECT_FALSE(SetWalkPlace(text, {9, 0}, kWalkTo, {1.0f, 1.0f}).ok());
  EXPECT_EQ(text.text(), Read(kScript).text());
}

TEST(SnapOnFloor, PrefersMarksThatAreNearThenTheGrid) {
  const std::vector<glm::vec2> marks = {{1.02f, 2.03f}, {1.2f, 2.0f}};
  EXPECT_EQ(SnapOnFloor({1.03f, 2.04f}, 0.05f, marks, 0.05f), marks[0]);
  const glm::vec2 on_grid = SnapOnFloor({0.513f, -0.277f}, 0.05f, marks, 0.05f);
  EXPECT_NEAR(on_grid.x, 0.5f, 1e-5f);
  EXPECT_NEAR(on_grid.y, -0.3f, 1e-5f);
  EXPECT_EQ(SnapOnFloor({0.513f, -0.277f}, 0.0f, {}, 0.05f), glm::vec2(0.513f, -0.277f));
}

TEST(WalkMarks, AreTheEndsOfAllWalksButTheOneThatMoves) {
  const TimelineText text = Read(kScript);
  EXPECT_EQ(WalkMarks(text, std::nullopt).size(), 4u);
  EXPECT_EQ(WalkMarks(text, TimelineItem{1, 1}).size(), 3u);
}

}  // namespace
}  // namespace lararium::editor
