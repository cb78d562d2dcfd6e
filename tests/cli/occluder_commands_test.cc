#include "editor/cli/occluder_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "editor/text/text.h"
#include "tests/jobs/two_places.h"

namespace lararium::editor {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

class Occluders : public testing::Test {
 protected:
  Occluders() {
    EXPECT_TRUE(CreateProject(paths_, "Tavern").ok());
    ProjectDocument document = *LoadProject(paths_);
    document.places.resize(1);
    document.places[0].name = "bar";
    document.places[0].occluders.resize(1);
    document.places[0].occluders[0].name = "face1";
    document.places[0].occluders[0].corners.resize(3);
    EXPECT_TRUE(SaveProject(paths_, document).ok());
  }

  Result<CommandResult> Run(OccluderOptions options) {
    options.project = paths_.folder;
    return RunOccluder(options);
  }
  std::string Problem(OccluderOptions options) {
    return Run(std::move(options)).status().message();
  }
  OccluderDocument Saved(size_t index) {
    return LoadProject(paths_)->places[0].occluders.at(index);
  }

  const test::TemporaryFolder folder_;
  const ProjectPaths paths_{folder_ / "tavern.lararium"};
};

TEST_F(Occluders, AShapeIsAddedMovedSizedAndRemoved) {
  const auto added = Run({.add = "gate",
                          .shape = "arch",
                          .sizes = {"width=4", "opening=2"},
                          .at = {1, 0, -2},
                          .turn = {90}});
  ASSERT_TRUE(added.ok()) << added.message();
  EXPECT_THAT(added->text, HasSubstr("gate: arch, width 4, height 3, depth 0.3, opening 2"));
  EXPECT_EQ(added->json["bar"][1]["shape"]["opening"], 2.0);
  EXPECT_EQ(added->json["bar"][1]["blocks_walking"], true);
  EXPECT_EQ(Saved(1).stage_from_mesh.translation, Vector3d(1, 0, -2));
  // After a turn to the left, its width is parallel to -z of the stage.
  EXPECT_LT((Saved(1).stage_from_mesh.rotation * Vector3d::UnitX() + Vector3d::UnitZ()).norm(),
            1e-12);

  ASSERT_TRUE(Run({.set = "gate",
                   .sizes = {"spring=1"},
                   .turn = {90, -90},
                   .scale = 0.5,
                   .receives_shadow = "no",
                   .blocks_walking = "no"})
                  .ok());
  const OccluderDocument changed = Saved(1);
  EXPECT_EQ(changed.shape->spring, 1.0);
  EXPECT_EQ(changed.shape->width, 4.0);
  EXPECT_EQ(changed.stage_from_mesh.scale, 0.5);
  EXPECT_EQ(changed.stage_from_mesh.translation, Vector3d(1, 0, -2)) << "as it was";
  // Tilted backwards it is flat on the floor.
  EXPECT_NEAR((changed.stage_from_mesh.rotation * Vector3d::UnitY()).y(), 0.0, 1e-12);
  EXPECT_TRUE(!changed.receives_shadow && changed.blocks_sound && !changed.blocks_walking);
  EXPECT_THAT(Run({})->text, HasSubstr("receives no shadow; does not block walking"));

  ASSERT_TRUE(Run({.remove = "gate"}).ok());
  EXPECT_EQ(LoadProject(paths_)->places[0].occluders.size(), 1u);
}

TEST_F(Occluders, AFloorIsNotInTheWay) {
  ASSERT_TRUE(Run({.add = "ground", .shape = "floor", .sizes = {"depth=4"}}).ok());
  const OccluderDocument ground = Saved(1);
  EXPECT_EQ(ground.shape->depth, 4.0);
  EXPECT_TRUE(ground.receives_shadow && !ground.blocks_sound && !ground.blocks_walking);
}

TEST_F(Occluders, AModelIsAddedByItsPathFromTheProject) {
  const auto file = paths_.folder / "models" / "counter.glb";
  ASSERT_TRUE(Run({.add = "counter", .model = file, .blocks_sound = "no"}).ok());
  EXPECT_EQ(Saved(1).kind(), OccluderDocument::Kind::kModel);
  EXPECT_EQ(Saved(1).file, "models/counter.glb");
  EXPECT_FALSE(Saved(1).blocks_sound);
  ASSERT_TRUE(Run({.set = "counter", .blocks_sound = "yes"}).ok());
  EXPECT_TRUE(Saved(1).blocks_sound);
}

TEST_F(Occluders, WhatWasDrawnHasADepthAndFlagsButNoPlace) {
  ASSERT_TRUE(Run({.set = "face1", .sizes = {"depth=0.6"}, .blocks_walking = "no"}).ok());
  EXPECT_EQ(Saved(0).depth, 0.6);
  EXPECT_FALSE(Saved(0).blocks_walking);
  EXPECT_THAT(Problem({.set = "face1", .at = {0, 0, 0}}),
              HasSubstr("drawn on the training images"));
  EXPECT_THAT(Problem({.set = "face1", .sizes = {"width=1"}}), HasSubstr("it has depth"));
  EXPECT_THAT(Problem({.set = "face1", .sizes = {"depth=-1"}}), HasSubstr("between 0 and 1000"));
}

class DrawnByPicks : public testing::Test, protected test::TwoPlacesProject {
 protected:
  Result<CommandResult> Run(OccluderOptions options) {
    options.project = paths_.folder;
    options.place = "site";
    return RunOccluder(options);
  }
  // The front of a counter, half a metre high, in the form of --seen.
  std::string Seen(size_t keyframe) {
    const vision::SceneDatabase map = MapOf(world_, test::kSiteFromStage);
    std::string text = map.keyframes[keyframe].name;
    for (const Vector3d& corner : kCorners) {
      const Eigen::Vector2d pixel = See(world_, map, corner, keyframe).pixel;
      text += Text(",%.6f,%.6f", pixel.x(), pixel.y());
    }
    return text;
  }
  OccluderDocument Saved(size_t index) {
    return LoadProject(paths_)->places[1].occluders.at(index);
  }

  const std::array<Vector3d, 4> kCorners = {
      Vector3d(-0.6, 0.0, 0.4), {0.6, 0.0, 0.4}, {0.6, 0.5, 0.4}, {-0.6, 0.5, 0.4}};
};

TEST_F(DrawnByPicks, CornersInTwoImagesMakeAFaceWhereTheyAre) {
  const auto drawn = Run({.draw = "counter",
                          .seen = {Seen(2), Seen(9)},
                          .sizes = {"depth=0.3"},
                          .blocks_sound = "no"});
  ASSERT_TRUE(drawn.ok()) << drawn.message();
  EXPECT_THAT(drawn->text, HasSubstr("counter: 4 corners, 0.00 px off; 0.0 cm off their plane"));
  const OccluderDocument counter = Saved(1);
  EXPECT_EQ(counter.depth, 0.3);
  EXPECT_FALSE(counter.blocks_sound);
  ASSERT_EQ(counter.corners.size(), 4u);
  const vision::SceneDatabase map = MapOf(world_, test::kSiteFromStage);
  for (size_t i = 0; i < 4; ++i) {
    const auto found = stage::SolveAnchor(counter.corners[i], map);
    ASSERT_TRUE(found.ok()) << found.message();
    EXPECT_LT((test::kSiteFromStage.Inverse() * found->point_in_map - kCorners[i]).norm(), 1e-4);
  }
}

TEST_F(DrawnByPicks, DrawingGoesOnInAnotherImageAndASecondPickMovesACorner) {
  ASSERT_TRUE(Run({.draw = "counter", .seen = {Seen(2), Seen(9)}}).ok());
  const vision::SceneDatabase map = MapOf(world_, test::kSiteFromStage);
  const Eigen::Vector2d third = See(world_, map, kCorners[2], 5).pixel;
  ASSERT_TRUE(
      Run({.draw = "counter", .seen = {Text("5.png,-,-,-,-,%.6f,%.6f,-,-", third.x(), third.y())}})
          .ok());
  EXPECT_EQ(Saved(1).corners[0].picks.size(), 2u) << "not seen there";
  EXPECT_EQ(Saved(1).corners[2].picks.size(), 3u);
  ASSERT_TRUE(Run({.draw = "counter", .seen = {Seen(9)}}).ok());
  EXPECT_EQ(Saved(1).corners[0].picks.size(), 2u);
}

TEST_F(DrawnByPicks, WhatCannotBeLocatedIsRefusedAndNothingIsSaved) {
  const Json before = FormatProject(*LoadProject(paths_));
  const auto problem = [&](OccluderOptions options) {
    return Run(std::move(options)).status().message();
  };
  EXPECT_THAT(problem({.draw = "counter", .seen = {Seen(2)}}), HasSubstr("corner 1"));
  EXPECT_THAT(problem({.draw = "counter", .seen = {"2.png,3,4,5"}}), HasSubstr("FRAME,x,y"));
  EXPECT_THAT(problem({.draw = "counter", .seen = {"2.png,3,-"}}), HasSubstr("FRAME,x,y"));
  EXPECT_THAT(problem({.draw = "counter", .seen = {"2.png"}}), HasSubstr("FRAME,x,y"));
  EXPECT_THAT(problem({.draw = "counter", .seen = {"99.png,3,4"}}),
              HasSubstr("not a training image"));
  EXPECT_THAT(problem({.draw = "counter", .seen = {"2.png,3,99999"}}), HasSubstr("outside"));
  EXPECT_THAT(problem({.draw = "a counter", .seen = {Seen(2), Seen(9)}}),
              HasSubstr("not a valid name"));
  EXPECT_EQ(FormatProject(*LoadProject(paths_)), before);
}

TEST_F(Occluders, WhatCannotBeIsRefusedAndNothingIsSaved) {
  ASSERT_TRUE(Run({.add = "pillar", .shape = "cylinder"}).ok());
  const Json before = FormatProject(*LoadProject(paths_));
  EXPECT_THAT(Problem({.add = "pillar", .shape = "box"}), HasSubstr("already"));
  EXPECT_THAT(Problem({.add = "a pillar", .shape = "box"}), HasSubstr("not a valid name"));
  EXPECT_THAT(Problem({.set = "column", .at = {0, 0, 0}}), HasSubstr("it has face1, pillar"));
  EXPECT_THAT(Problem({.remove = "column"}), HasSubstr("no occluder \"column\""));
  EXPECT_THAT(Problem({.place = "moon"}), HasSubstr("has no place \"moon\""));
  EXPECT_THAT(Problem({.set = "pillar", .sizes = {"width=1"}}),
              HasSubstr("it has diameter, height"));
  EXPECT_THAT(Problem({.set = "pillar", .sizes = {"height=0"}}),
              HasSubstr("from 0.001 m to 1000 m"));
  for (const char* wrong : {"height", "height=", "height=tall", "height=1m", "=1", ""}) {
    EXPECT_THAT(Problem({.set = "pillar", .sizes = {wrong}}), HasSubstr("--size")) << wrong;
  }
  EXPECT_THAT(Problem({.set = "pillar", .at = {0, NAN, 0}}), HasSubstr("not a position"));
  EXPECT_EQ(FormatProject(*LoadProject(paths_)), before);
}

}  // namespace
}  // namespace lararium::editor
