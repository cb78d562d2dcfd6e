#include "shared/show/picture_camera.h"

#include <gtest/gtest.h>

namespace lararium::show {
namespace {

constexpr geometry::CameraModel kRawCamera{640, 480, 525.0, 527.0, 321.5, 238.5};

TEST(PictureCamera, OfTheSameProportionsIsTheWholeView) {
  EXPECT_EQ(PictureCamera(kRawCamera, 1280, 960), kRawCamera);
  EXPECT_EQ(PictureCamera(kRawCamera, 320, 240), kRawCamera);
}

TEST(PictureCamera, CutsWhatIsTooHighOrTooWideAboutTheMiddle) {
  const geometry::CameraModel wide = PictureCamera(kRawCamera, 1280, 720);
  EXPECT_EQ(wide.width, 640);
  EXPECT_EQ(wide.height, 360);
  EXPECT_EQ(wide.cy, kRawCamera.cy - 60.0);
  EXPECT_EQ(wide.cx, kRawCamera.cx);
  const geometry::CameraModel high = PictureCamera(kRawCamera, 480, 480);
  EXPECT_EQ(high.width, 480);
  EXPECT_EQ(high.cx, kRawCamera.cx - 80.0);
}

TEST(PictureCamera, StretchesNothing) {
  for (const auto& [width, height] : {std::pair(1280, 720), {1920, 1200}, {333, 777}, {640, 480}}) {
    const geometry::CameraModel picture =
        PictureCamera(kRawCamera, width, height).Resized(width, height);
    EXPECT_NEAR(picture.fx / picture.fy, kRawCamera.fx / kRawCamera.fy, 0.003) << width;
  }
}

TEST(PictureCamera, LeavesOutWhatIsNotSeen) {
  const ViewPart part(Eigen::Vector2d(-0.2, -0.1), Eigen::Vector2d(0.3, 0.1));
  const geometry::CameraModel seen = PartOfView(kRawCamera, part);
  // 0.5 and 0.2 units of the plane, rounded outwards to whole pixels; each ray stays at its pixel.
  EXPECT_NEAR(seen.width, 0.5 * kRawCamera.fx, 2.0);
  EXPECT_NEAR(seen.height, 0.2 * kRawCamera.fy, 2.0);
  EXPECT_NEAR(seen.PixelFromPlane(part.min()).x(), 0.0, 1.0);
  EXPECT_NEAR(seen.PixelFromPlane(part.max()).y(), seen.height - 1.0, 1.0);
  EXPECT_TRUE(seen.Contains(seen.PixelFromPlane(part.min())));
  EXPECT_TRUE(seen.Contains(seen.PixelFromPlane(part.max())));
  const geometry::CameraModel picture = PictureCamera(kRawCamera, 640, 480, part);
  EXPECT_LE(picture.width, seen.width);
  EXPECT_NEAR(picture.width * 480.0, picture.height * 640.0, 640.0);
}

TEST(PictureCamera, IsWholeForWhoeverSeesMoreOrNothing) {
  const Eigen::Vector2d wide(9.0, 9.0);
  EXPECT_EQ(PartOfView(kRawCamera, ViewPart(-wide, wide)), kRawCamera);
  EXPECT_EQ(PartOfView(kRawCamera, ViewPart(wide, 2.0 * wide)), kRawCamera);
  EXPECT_EQ(PartOfView(kRawCamera, {}), kRawCamera);
}

TEST(PictureEye, SeesWhatIsAsFarAsThePictureWhereTheCameraDid) {
  const PictureEye eye{{0.032, -0.01, -0.06}, 2.5};
  const geometry::CameraModel display = ForEye(kRawCamera, eye);
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0.0, 0.0, 2.5), {1.0, -0.7, 2.5}, {-0.4, 0.9, 2.5}}) {
    EXPECT_LT((*display.Project(point - eye.in_camera) - *kRawCamera.Project(point)).norm(), 1e-9);
  }
}

TEST(PictureEye, SeesNearerPeopleWithTheDisparityOfBothEyes) {
  const PictureEye left{{-0.032, 0.0, 0.0}, 3.0};
  const PictureEye right{{0.032, 0.0, 0.0}, 3.0};
  const Eigen::Vector3d near(0.1, 0.2, 1.5);
  const double disparity = ForEye(kRawCamera, left).Project(near - left.in_camera)->x() -
                           ForEye(kRawCamera, right).Project(near - right.in_camera)->x();
  EXPECT_NEAR(disparity, kRawCamera.fx * 0.064 * (1.0 / 1.5 - 1.0 / 3.0), 1e-9);
}

TEST(PictureEye, OfAPictureAtInfinityLooksParallel) {
  EXPECT_EQ(ForEye(kRawCamera, {{0.032, 0.0, -0.05}}), kRawCamera);
}

}  // namespace
}  // namespace lararium::show
