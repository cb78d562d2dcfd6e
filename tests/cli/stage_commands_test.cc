#include "editor/cli/stage_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/jobs/staging.h"
#include "editor/text/text.h"
#include "tests/jobs/two_places.h"

namespace lararium::editor {
namespace {

using Eigen::Vector3d;
using geometry::Similarity3;
using testing::HasSubstr;

class StageCommands : public testing::Test, protected test::TwoPlacesProject {
 protected:
  Result<CommandResult> Run(StageOptions options) {
    options.project = paths_.folder;
    options.place = "site";
    return RunStage(options);
  }
  PlaceDocument Site() { return LoadProject(paths_)->places[1]; }
  Similarity3 MapFromStage() {
    const StagedMap map = *LoadStagedMap(paths_, Site());
    return map.picks.map_from_picked * Site().picked_from_stage;
  }
  // A pick in the form of --pick.
  std::string Seen(const std::string& point, const Vector3d& on_stage, size_t keyframe) {
    const stage::Pick pick = See(world_, MapOf(world_, test::kSiteFromStage), on_stage, keyframe);
    return Text("%s=%s,%.6f,%.6f", point.c_str(), pick.frame.c_str(), pick.pixel.x(),
                pick.pixel.y());
  }
};

TEST_F(StageCommands, PicksLayTheStageAndAKnownLengthScalesIt) {
  StageOptions options;
  options.clear = {"origin", "forward", "floor"};
  for (const size_t keyframe : {2, 9}) {
    options.picks.push_back(Seen("origin", {0.5, 0.0, 0.5}, keyframe));
    options.picks.push_back(Seen("forward", {0.5, 0.0, -0.5}, keyframe));
    options.picks.push_back(Seen("floor", {1.0, 0.0, 0.0}, keyframe));
    options.picks.push_back(Seen("length_from", {0.0, 0.0, 0.0}, keyframe));
    options.picks.push_back(Seen("length_to", {0.0, 1.0, 0.0}, keyframe));
  }
  options.length = 0.5;  // The actual distance is a metre.
  const auto laid = Run(options);
  ASSERT_TRUE(laid.ok()) << laid.message();
  EXPECT_THAT(laid->text, HasSubstr("known length: 0.500 m"));
  EXPECT_EQ(laid->json["place"], "site");

  const Similarity3 stage_from_new = test::kSiteFromStage.Inverse() * MapFromStage();
  EXPECT_NEAR(stage_from_new.scale, 2.0, 1e-3);
  EXPECT_LT((stage_from_new.translation - Vector3d(0.5, 0.0, 0.5)).norm(), 1e-3);
}

TEST_F(StageCommands, APickInTheSameImageTakesThePlaceOfTheOneBefore) {
  ASSERT_TRUE(Run({.picks = {Seen("origin", {0.1, 0.0, 0.0}, 5)}}).ok());
  EXPECT_EQ(Site().picks.origin.picks.size(), 3u);
  ASSERT_TRUE(Run({.picks = {Seen("origin", {0.1, 0.0, 0.0}, 6)}}).ok());
  EXPECT_EQ(Site().picks.origin.picks.size(), 4u);
}

TEST_F(StageCommands, OnePickIsForgottenAlone) {
  const std::string frame = Site().picks.origin.picks[1].frame;
  ASSERT_TRUE(Run({.clear = {"origin=" + frame}}).ok());
  const PlaceDocument site = Site();
  ASSERT_EQ(site.picks.origin.picks.size(), 2u);
  EXPECT_NE(site.picks.origin.picks[0].frame, frame);
  EXPECT_NE(site.picks.origin.picks[1].frame, frame);
  EXPECT_EQ(site.picks.forward.picks.size(), 3u);
}

TEST_F(StageCommands, NumbersMoveItByHandAndBackToThePicks) {
  ASSERT_TRUE(Run({.at = {0.3, 0.1, -0.2}, .turn = {90}, .scale = 1.5}).ok());
  PlaceDocument site = Site();
  EXPECT_EQ(site.picked_from_stage.translation, Vector3d(0.3, 0.1, -0.2));
  EXPECT_EQ(site.picked_from_stage.scale, 1.5);
  ASSERT_TRUE(Run({.scale = 2.0, .nudge = {0.01, 0.0, -0.02}}).ok());
  site = Site();
  EXPECT_EQ(site.picked_from_stage.translation, Vector3d(0.3, 0.1, -0.2)) << "as it was";
  EXPECT_EQ(site.picked_from_stage.scale, 2.0);
  EXPECT_EQ(site.camera_nudge, Vector3d(0.01, 0.0, -0.02));
  EXPECT_THAT(Run({})->text, HasSubstr("at 0.300,0.100,-0.200, turned 90.0,0.0,0.0 degrees"));
  ASSERT_TRUE(Run({.back_to_picks = true}).ok());
  EXPECT_EQ(Site().picked_from_stage.scale, 1.0);
}

TEST_F(StageCommands, WhatCannotBeIsRefusedAndNothingIsSaved) {
  const Json before = FormatProject(*LoadProject(paths_));
  const auto problem = [&](StageOptions options) {
    return Run(std::move(options)).status().message();
  };
  EXPECT_THAT(problem({.picks = {"middle=1.png,3,4"}}),
              HasSubstr("choose one of origin, forward, floor, length_from, length_to"));
  EXPECT_THAT(problem({.picks = {"origin"}}), HasSubstr("POINT=FRAME,x,y"));
  EXPECT_THAT(problem({.picks = {"origin=1.png,3"}}), HasSubstr("FRAME,x,y"));
  EXPECT_THAT(problem({.picks = {"origin=99.png,3,4"}}), HasSubstr("not a training image"));
  EXPECT_THAT(problem({.picks = {"origin=1.png,3,99999"}}), HasSubstr("outside of the image"));
  EXPECT_THAT(problem({.clear = {"middle"}}), HasSubstr("not a point of the stage"));
  EXPECT_THAT(problem({.clear = {"origin=99.png"}}), HasSubstr("it was picked in"));
  EXPECT_THAT(problem({.clear = {"length_to=99.png"}}), HasSubstr("picked nowhere"));
  EXPECT_THAT(problem({.tag_size = 0.1, .tag_family = "tag9h9"}), HasSubstr("tag9h9"));
  EXPECT_THAT(problem({.on_floor = true}), HasSubstr("no large level surface"));
  EXPECT_EQ(FormatProject(*LoadProject(paths_)), before);
}

}  // namespace
}  // namespace lararium::editor
