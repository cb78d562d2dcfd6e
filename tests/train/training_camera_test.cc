#include "editor/train/training_camera.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace lararium::train {
namespace {

// A folder of images, of which only the cameras are asked for.
class Folder : public capture::FrameSource {
 public:
  explicit Folder(std::vector<capture::SourceCamera> cameras) : cameras_(std::move(cameras)) {}

  Result<std::optional<geometry::Frame>> Next() override { return {std::nullopt}; }
  Status Seek(int64_t) override { return Status(); }
  std::optional<int64_t> frame_count() const override { return 0; }
  int width() const override { return 640; }
  int height() const override { return 640; }
  double frames_per_second() const override { return 30.0; }
  bool live() const override { return false; }
  std::vector<capture::SourceCamera> Cameras() const override { return cameras_; }
  std::string FrameName(int64_t) const override { return ""; }

 private:
  std::vector<capture::SourceCamera> cameras_;
};

const geometry::CameraModel kLying = {.width = 640,
                                      .height = 480,
                                      .fx = 600.0,
                                      .fy = 590.0,
                                      .cx = 330.0,
                                      .cy = 230.0,
                                      .k1 = -0.1,
                                      .p1 = 0.001,
                                      .p2 = -0.002};

Folder LyingUprightAndReversed() {
  return Folder({{.size = {640, 480}, .area = {0, 80, 640, 480}},
                 {.size = {480, 640}, .area = {80, 0, 480, 640}, .lens_of = 0, .quarter_turns = 1},
                 {.size = {640, 480}, .area = {0, 80, 640, 480}, .lens_of = 0, .quarter_turns = 2},
                 {.size = {64, 48}, .area = {288, 296, 64, 48}}});
}

TEST(Turned, TurnsRays) {
  const geometry::CameraModel turned = Turned(kLying);
  EXPECT_EQ(turned.width, 480);
  EXPECT_EQ(turned.height, 640);
  const Eigen::Vector2d ray = kLying.PlaneFromPixel({100.25, 400.75});
  const Eigen::Vector2d turned_ray = turned.PlaneFromPixel({479 - 400.75, 100.25});
  EXPECT_NEAR(turned_ray.x(), -ray.y(), 1e-9);
  EXPECT_NEAR(turned_ray.y(), ray.x(), 1e-9);
  EXPECT_EQ(Turned(Turned(Turned(turned))), kLying);
}

TEST(CamerasOf, GivesTheIntrinsicsToAllImagesOfTheLens) {
  const auto cameras = CamerasOf(LyingUprightAndReversed(), kLying);
  ASSERT_TRUE(cameras.ok()) << cameras.message();
  EXPECT_EQ(LensCount(*cameras), 2u);
  EXPECT_EQ(ModelOfArea((*cameras)[0]), kLying);
  EXPECT_EQ(ModelOfArea((*cameras)[1]), Turned(kLying));
  EXPECT_EQ(ModelOfArea((*cameras)[2]), Turned(Turned(kLying)));
  EXPECT_TRUE((*cameras)[2].given);
  EXPECT_FALSE((*cameras)[3].given);
}

TEST(CamerasOf, GivesIntrinsicsOfUprightImagesToLyingOnesToo) {
  const auto cameras = CamerasOf(LyingUprightAndReversed(), Turned(kLying));
  ASSERT_TRUE(cameras.ok()) << cameras.message();
  EXPECT_EQ(ModelOfArea((*cameras)[0]), kLying);
  EXPECT_EQ(ModelOfArea((*cameras)[1]), Turned(kLying));
}

TEST(TurnedPixel, FollowsTheTurnedModel) {
  const auto cameras = CamerasOf(LyingUprightAndReversed(), kLying);
  ASSERT_TRUE(cameras.ok()) << cameras.message();
  const Eigen::Vector2d pixel(100.0, 300.0);
  const Eigen::Vector2d ray = (*cameras)[0].model.PlaneFromPixel(pixel);
  const Eigen::Vector2d upright =
      (*cameras)[1].model.PlaneFromPixel(TurnedPixel((*cameras)[0], (*cameras)[1], pixel));
  EXPECT_LT((upright - Eigen::Vector2d(-ray.y(), ray.x())).norm(), 1e-9);
  EXPECT_EQ(
      TurnedPixel((*cameras)[1], (*cameras)[0], TurnedPixel((*cameras)[0], (*cameras)[1], pixel)),
      pixel);
}

}  // namespace
}  // namespace lararium::train
