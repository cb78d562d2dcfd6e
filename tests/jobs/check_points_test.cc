#include "editor/jobs/check_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "editor/cli/check_commands.h"
#include "editor/document/picked_images.h"
#include "shared/core/units.h"
#include "tests/jobs/two_places.h"

namespace lararium::editor {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Similarity3;
using test::kMaquetteFromStage;
using test::kSiteFromStage;
using test::MapOf;
using test::See;
using testing::HasSubstr;
using Verdict = CheckPointReport::Verdict;

class CheckPoints : public testing::Test {
 protected:
  CheckPoints() {
    for (size_t i = 0; i < positions_.size(); ++i) {
      document_.check_points.push_back({"point " + std::to_string(i + 1), positions_[i]});
      PickAll(i, positions_[i]);
    }
  }

  // Picks a point in three images, as if it were at a position.
  void PickAll(size_t point, const Vector3d& position) {
    for (const size_t keyframe : {1, 5, 10}) {
      SetCheckPick(place_, document_.check_points[point].name,
                   See(world_, map_, position, keyframe));
    }
  }
  void KeepPoints(size_t count) { document_.check_points.resize(count); }
  CheckReport Check() { return CheckStaging(document_, place_, map_, kSiteFromStage); }

  const test::SyntheticWorld world_ = test::MakeSyntheticWorld({.points = 60});
  const vision::SceneDatabase map_ = MapOf(world_, kSiteFromStage);
  const std::vector<Vector3d> positions_ = {
      {-1.2, 0.3, 0.5}, {1.4, 0.2, 0.4}, {0.2, 1.6, -0.7}, {0.7, 0.9, 1.1}, {-0.6, 1.1, 0.2}};
  ProjectDocument document_;
  PlaceDocument place_;
};

TEST_F(CheckPoints, AreWhereTheStageSaysWhereItLiesAsItShould) {
  const CheckReport report = Check();
  EXPECT_EQ(report.verdict, CheckReport::Verdict::kGood);
  EXPECT_EQ(report.compared, 5);
  EXPECT_LT(report.rms_m, 1e-6);
  EXPECT_LT(report.rms_px, 1e-6);
  EXPECT_THAT(CheckAdvice(report, false), HasSubstr("as it should"));
}

TEST_F(CheckPoints, TellHowFarAMovedStageIsOffAndWhatMendsIt) {
  place_.picked_from_stage.translation = {0.2, 0.0, 0.0};
  place_.picked_from_stage.rotation = Eigen::AngleAxisd(3.0 * kRadiansPerDegree, Vector3d::UnitY());
  place_.picked_from_stage.scale = 1.05;
  const CheckReport report = Check();
  EXPECT_EQ(report.verdict, CheckReport::Verdict::kPoor);
  for (size_t i = 0; i < positions_.size(); ++i) {
    // A point at x is located where picked_from_stage maps to x.
    const Vector3d found = place_.picked_from_stage.Inverse() * positions_[i];
    EXPECT_LT((report.points[i].found - found).norm(), 1e-6);
    EXPECT_NEAR(report.points[i].distance_m, (found - positions_[i]).norm(), 1e-6);
    EXPECT_EQ(report.points[i].verdict, Verdict::kOff);
  }
  EXPECT_TRUE(report.fit_good);
  EXPECT_TRUE(report.doubtful.empty());
  EXPECT_NEAR(report.scale, 1.0 / 1.05, 1e-6);
  EXPECT_NEAR(report.turn, 3.0 * kRadiansPerDegree, 1e-6);

  ASSERT_TRUE(report.map_from_stage);
  place_.picked_from_stage = kSiteFromStage.Inverse() * *report.map_from_stage;
  EXPECT_EQ(Check().verdict, CheckReport::Verdict::kGood);
  EXPECT_LT(Check().rms_m, 1e-6);
}

TEST_F(CheckPoints, AreOffByTheSameStageMetresOnTheMaquetteAsOnTheSite) {
  place_.picked_from_stage.translation = {0.0, 0.07, 0.0};
  const CheckReport site = Check();
  const CheckReport maquette =
      CheckStaging(document_, place_, MapOf(world_, kMaquetteFromStage), kMaquetteFromStage);
  for (size_t i = 0; i < positions_.size(); ++i) {
    EXPECT_NEAR(site.points[i].distance_m, 0.07, 1e-6);
    EXPECT_NEAR(maquette.points[i].distance_m, 0.07, 1e-6);
    EXPECT_NEAR(maquette.points[i].distance_px, site.points[i].distance_px, 1e-6);
    EXPECT_NEAR(maquette.points[i].deviation_m, site.points[i].deviation_m, 1e-6);
  }
}

TEST_F(CheckPoints, OnePickedFromAlmostOneDirectionSaysNothing) {
  const test::SyntheticWorld world = test::MakeSyntheticWorld({.points = 60, .cameras = 24});
  const vision::SceneDatabase map = MapOf(world, kSiteFromStage);
  KeepPoints(3);
  PlaceDocument place;
  for (size_t i = 0; i < 3; ++i) {
    for (const size_t keyframe : {size_t{4}, i == 0 ? size_t{5} : size_t{18}}) {
      SetCheckPick(place, document_.check_points[i].name, See(world, map, positions_[i], keyframe));
    }
  }
  const CheckReport report = CheckStaging(document_, place, map, kSiteFromStage);
  EXPECT_EQ(report.points[0].verdict, Verdict::kWeak);
  EXPECT_EQ(report.points[1].verdict, Verdict::kGood);
  EXPECT_EQ(report.verdict, CheckReport::Verdict::kUnknown);
  EXPECT_GT(report.points[0].deviation_m, 5.0 * report.points[1].deviation_m);
  EXPECT_THAT(CheckAdvice(report, false), HasSubstr("farther apart"));
}

TEST_F(CheckPoints, AWrongPickAmongOthersIsFoundByItsFrame) {
  KeepPoints(3);
  stage::Pick wrong = See(world_, map_, positions_[1], 5);
  wrong.pixel += Vector2d(4.0, 25.0);
  SetCheckPick(place_, "point 2", wrong);
  const CheckReport report = Check();
  EXPECT_NE(report.verdict, CheckReport::Verdict::kGood);
  EXPECT_EQ(report.points[1].verdict, Verdict::kPicksDisagree);
  EXPECT_EQ(report.points[1].odd_frame, wrong.frame);
  EXPECT_THAT(CheckAdvice(report, false), HasSubstr(wrong.frame));
  EXPECT_EQ(report.points[0].verdict, Verdict::kGood);
}

TEST_F(CheckPoints, AWrongCornerPickedInEveryImageIsFoundByTheOthers) {
  KeepPoints(3);
  PickAll(2, positions_[2] + Vector3d(0.4, 0.0, 0.0));
  const CheckReport report = Check();
  EXPECT_EQ(report.verdict, CheckReport::Verdict::kPoor);
  EXPECT_EQ(report.points[2].verdict, Verdict::kOff);
  EXPECT_NEAR(report.points[2].distance_m, 0.4, 1e-6);
  EXPECT_EQ(report.doubtful, "point 3");
  EXPECT_THAT(CheckAdvice(report, false), HasSubstr("Look at point 3 again"));
}

TEST_F(CheckPoints, AWrongCornerIsFoundWhereTheStageLiesWrongToo) {
  place_.picked_from_stage.translation = {0.0, 0.0, 0.5};
  PickAll(3, positions_[3] + Vector3d(0.0, 0.6, 0.0));
  const CheckReport report = Check();
  EXPECT_EQ(report.verdict, CheckReport::Verdict::kPoor);
  EXPECT_EQ(report.doubtful, "point 4");
  EXPECT_TRUE(report.fit_good) << "the others say where the stage lies";
  ASSERT_TRUE(report.map_from_stage);
  EXPECT_LT((*report.map_from_stage * positions_[0] - kSiteFromStage * positions_[0]).norm(), 1e-6);
}

TEST_F(CheckPoints, FewerThanThreeOrOnALineSayNothing) {
  KeepPoints(2);
  EXPECT_EQ(Check().verdict, CheckReport::Verdict::kUnknown);
  EXPECT_THAT(CheckAdvice(Check(), false), HasSubstr("at least three"));
  document_.check_points.push_back({"middle", 0.5 * (positions_[0] + positions_[1])});
  PickAll(2, document_.check_points[2].position);
  EXPECT_EQ(Check().compared, 3);
  EXPECT_EQ(Check().verdict, CheckReport::Verdict::kUnknown);
  EXPECT_THAT(CheckAdvice(Check(), false), HasSubstr("on a line"));
}

TEST_F(CheckPoints, OneThatCannotBeLocatedIsToldAndSpoilsTheVerdict) {
  KeepPoints(4);
  ClearCheckPicks(place_, "point 4");
  EXPECT_EQ(Check().points[3].verdict, Verdict::kNotPicked);
  EXPECT_EQ(Check().verdict, CheckReport::Verdict::kGood) << "three are enough";
  SetCheckPick(place_, "point 4", {12345, "gone.png", {10.0, 10.0}});
  EXPECT_EQ(Check().points[3].verdict, Verdict::kNotLocated);
  EXPECT_EQ(Check().verdict, CheckReport::Verdict::kPoor);
  EXPECT_THAT(CheckAdvice(Check(), false), HasSubstr("gone.png"));
}

TEST_F(CheckPoints, RenamingAndRemovingTakeThePicksOfEveryPlaceAlong) {
  document_.places = {place_, place_};
  RenameCheckPoint(document_, "point 1", "counter, left front corner");
  EXPECT_EQ(document_.check_points[0].name, "counter, left front corner");
  for (const PlaceDocument& place : document_.places) {
    EXPECT_EQ(FindCheckPicks(place, "point 1"), nullptr);
    ASSERT_NE(FindCheckPicks(place, "counter, left front corner"), nullptr);
    EXPECT_EQ(FindCheckPicks(place, "counter, left front corner")->picks.size(), 3u);
  }
  RemoveCheckPoint(document_, "counter, left front corner");
  EXPECT_EQ(document_.check_points.size(), 4u);
  EXPECT_EQ(FindCheckPicks(document_.places[1], "counter, left front corner"), nullptr);
}

TEST_F(CheckPoints, APointWhoseLastPickIsRemovedIsNotPickedAnyMore) {
  for (const size_t keyframe : {1, 5}) {
    EXPECT_TRUE(RemoveCheckPick(place_, "point 1", See(world_, map_, positions_[0], keyframe)));
    ASSERT_NE(FindCheckPicks(place_, "point 1"), nullptr);
  }
  EXPECT_FALSE(RemoveCheckPick(place_, "point 1", See(world_, map_, positions_[0], 5)));
  EXPECT_TRUE(RemoveCheckPick(place_, "point 1", See(world_, map_, positions_[0], 10)));
  EXPECT_EQ(FindCheckPicks(place_, "point 1"), nullptr);
  EXPECT_EQ(Check().points[0].verdict, Verdict::kNotPicked);
  EXPECT_EQ(FindCheckPicks(place_, "point 2")->picks.size(), 3u);
}

class TwoPlaces : public testing::Test, protected test::TwoPlacesProject {};

TEST_F(TwoPlaces, TheSubcommandSetsPicksLaysAndReports) {
  const auto run = [&](CheckPointsOptions options) {
    options.project = paths_.folder;
    return RunCheckPoints(options);
  };
  EXPECT_THAT(run({})->text, HasSubstr("no check points"));
  const std::vector<std::pair<std::string, Vector3d>> points = {
      {"left", {-1.2, 0.3, 0.5}}, {"right", {1.4, 0.2, 0.4}}, {"top", {0.2, 1.6, -0.7}}};
  for (const auto& [name, at] : points) {
    ASSERT_TRUE(run({.set = name, .at = {at.x(), at.y(), at.z()}}).ok());
    for (const auto& [place, map_from_stage] :
         {std::pair{"maquette", kMaquetteFromStage}, {"site", kSiteFromStage}}) {
      const vision::SceneDatabase map = MapOf(world_, map_from_stage);
      for (const size_t keyframe : {2, 9}) {
        const stage::Pick seen = See(world_, map, at, keyframe);
        const auto picked = run({.place = place,
                                 .pick = name,
                                 .frame = seen.frame,
                                 .pixel = {seen.pixel.x(), seen.pixel.y()}});
        ASSERT_TRUE(picked.ok()) << picked.message();
      }
    }
  }
  auto report = run({});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_FALSE(report->failed) << report->text;
  EXPECT_EQ(report->json["maquette"]["verdict"], "good");
  EXPECT_EQ(report->json["site"]["verdict"], "good");
  EXPECT_LT(report->json["site"]["points"][2]["distance_cm"].get<double>(), 1e-3);

  // Removes one pick and picks it again. Removing the last pick removes the entry.
  const vision::SceneDatabase site = MapOf(world_, kSiteFromStage);
  const stage::Pick seen = See(world_, site, points[0].second, 2);
  ASSERT_TRUE(run({.place = "site", .frame = seen.frame, .clear = "left"}).ok());
  EXPECT_EQ(FindCheckPicks(LoadProject(paths_)->places[1], "left")->picks.size(), 1u);
  EXPECT_THAT(run({.place = "site", .frame = seen.frame, .clear = "left"}).status().message(),
              HasSubstr("was not picked in " + seen.frame));
  ASSERT_TRUE(run({.place = "site",
                   .pick = "left",
                   .frame = seen.frame,
                   .pixel = {seen.pixel.x(), seen.pixel.y()}})
                  .ok());

  // Moves the stage of the site; the check fails only there, and fitting the stage to the points
  // corrects it.
  ProjectDocument document = *LoadProject(paths_);
  document.places[1].picked_from_stage.translation = {0.3, 0.0, 0.1};
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  report = run({});
  EXPECT_TRUE(report->failed);
  EXPECT_EQ(report->json["maquette"]["verdict"], "good");
  EXPECT_EQ(report->json["site"]["verdict"], "poor");
  EXPECT_NEAR(report->json["site"]["rms_cm"].get<double>(), 100.0 * std::hypot(0.3, 0.1), 1e-3);
  EXPECT_FALSE(run({.place = "site", .lay = true})->failed);
  EXPECT_LT(LoadProject(paths_)->places[1].picked_from_stage.translation.norm(), 1e-6);

  ASSERT_TRUE(run({.place = "site", .set = "top", .here = true}).ok());
  EXPECT_LT((LoadProject(paths_)->check_points[2].position - points[2].second).norm(), 1e-6);
  ASSERT_TRUE(run({.remove = "top"}).ok());
  EXPECT_EQ(LoadProject(paths_)->check_points.size(), 2u);
  EXPECT_EQ(run({})->json["site"]["verdict"], "unknown");
}

TEST_F(TwoPlaces, TheSubcommandTellsWhatItLacks) {
  const auto problem = [&](CheckPointsOptions options) {
    options.project = paths_.folder;
    return RunCheckPoints(options).status().message();
  };
  ASSERT_EQ(problem({.set = "left", .at = {0, 0, 0}}), "");
  EXPECT_THAT(problem({.place = "moon"}), HasSubstr("has no place \"moon\""));
  EXPECT_THAT(problem({.place = "site", .pick = "right", .frame = "0", .pixel = {1, 1}}),
              HasSubstr("it has left"));
  EXPECT_THAT(problem({.pick = "left", .frame = "0", .pixel = {1, 1}}), HasSubstr("--place"));
  EXPECT_THAT(problem({.place = "site", .pick = "left", .frame = "nine", .pixel = {1, 1}}),
              HasSubstr("is not a training image"));
  const std::string frame = test::MakeSceneDatabase(world_).keyframes[0].name;
  EXPECT_THAT(problem({.place = "site", .pick = "left", .frame = frame, .pixel = {9999, 1}}),
              HasSubstr("outside of the image"));
  EXPECT_THAT(problem({.set = "left", .at = {0, NAN, 0}}), HasSubstr("not a position"));
  EXPECT_THAT(problem({.place = "site", .lay = true}), HasSubstr("at least three"));
  EXPECT_THAT(problem({.place = "site", .set = "new", .here = true}), HasSubstr("was not picked"));
}

}  // namespace
}  // namespace lararium::editor
