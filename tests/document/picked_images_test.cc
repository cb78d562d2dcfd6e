#include "editor/document/picked_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/jobs/two_places.h"

namespace lararium::editor {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::ElementsAre;

class PickedImagesTest : public testing::Test {
 protected:
  stage::Pick See(size_t keyframe) {
    return test::See(world_, map_, Vector3d(0.2, 0.4, -0.1), keyframe);
  }
  std::vector<std::optional<uint32_t>> KeyframesOf(const stage::Anchor& anchor) {
    std::vector<std::optional<uint32_t>> keyframes;
    for (const PickedImage& image : PickedImagesOf(anchor, map_)) {
      keyframes.push_back(image.keyframe);
    }
    return keyframes;
  }

  const test::SyntheticWorld world_ = test::MakeSyntheticWorld({.points = 60});
  const vision::SceneDatabase map_ = test::MapOf(world_, test::kSiteFromStage);
};

TEST_F(PickedImagesTest, ComeInTheOrderOfTheMapAndThoseThatItLacksLast) {
  const stage::Anchor anchor{"origin", {See(9), {12345, "gone.png", {1.0, 1.0}}, See(2), See(5)}};
  EXPECT_THAT(KeyframesOf(anchor), ElementsAre(2u, 5u, 9u, std::nullopt));
  EXPECT_EQ(NameOfImage(PickedImagesOf(anchor, map_).back().pick), "gone.png");
}

TEST_F(PickedImagesTest, AWrongPickIsFartherOffThanTheOthers) {
  stage::Anchor anchor{"origin", {See(1), See(4), See(7), See(10)}};
  for (const PickedImage& image : PickedImagesOf(anchor, map_)) {
    ASSERT_TRUE(image.error_px.has_value());
    EXPECT_LT(*image.error_px, 1e-6);
  }
  anchor.picks[2].pixel += Vector2d(12.0, -9.0);
  const std::vector<PickedImage> images = PickedImagesOf(anchor, map_);
  for (const size_t other : {0, 1, 3}) {
    EXPECT_GT(*images[2].error_px, 1.5 * *images[other].error_px) << other;
  }
}

TEST_F(PickedImagesTest, OneAloneIsNotKnownToBeOff) {
  EXPECT_FALSE(PickedImagesOf({"origin", {See(3)}}, map_)[0].error_px.has_value());
  EXPECT_TRUE(PickedImagesOf({"origin", {}}, map_).empty());
}

TEST_F(PickedImagesTest, StepsGoToTheNearestOneInEitherDirectionAndStopAtTheEnds) {
  const auto images =
      PickedImagesOf({"origin", {See(2), See(9), {12345, "gone.png", {1.0, 1.0}}}}, map_);
  EXPECT_EQ(NextPicked(images, 0, 1), 2u);
  EXPECT_EQ(NextPicked(images, 2, 1), 9u);
  EXPECT_EQ(NextPicked(images, 9, 1), std::nullopt);
  EXPECT_EQ(NextPicked(images, 9, -1), 2u);
  EXPECT_EQ(NextPicked(images, 5, -1), 2u);
  EXPECT_EQ(NextPicked(images, 2, -1), std::nullopt);
}

TEST_F(PickedImagesTest, RemovingAPickLeavesThoseOfOtherImagesAndSessionsAlone) {
  stage::Anchor anchor{"origin", {See(2), See(5), See(5)}};
  anchor.picks[2].session = 1;
  EXPECT_TRUE(RemovePick(anchor, See(5)));
  EXPECT_THAT(KeyframesOf({"origin", {anchor.picks[0]}}), ElementsAre(2u));
  ASSERT_EQ(anchor.picks.size(), 2u);
  EXPECT_EQ(anchor.picks[1].session, 1u);
  EXPECT_FALSE(RemovePick(anchor, See(5))) << "it is gone";
}

}  // namespace
}  // namespace lararium::editor
