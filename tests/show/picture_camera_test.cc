#include "shared/show/picture_camera.h"

#include <gtest/gtest.h>

namespace lararium::show {
namespace {

constexpr geometry::CameraModel kCamera{640, 480, 525.0, 527.0, 321.5, 238.5};

TEST(PictureCamera, OfTheSameProportionsIsTheWholeView) {
  EXPECT_EQ(PictureCamera(kCamera, 1280, 960), kCamera);
  EXPECT_EQ(PictureCamera(kCamera, 320, 240), kCamera);
}

TEST(PictureCamera, CutsWhatIsTooHighOrTooWideAboutTheMiddle) {
  const geometry::CameraModel wide = PictureCamera(kCamera, 1280, 720);
  EXPECT_EQ(wide.width, 640);
  EXPECT_EQ(wide.height, 360);
  EXPECT_EQ(wide.cy, kCamera.cy - 60.0);
  EXPECT_EQ(wide.cx, kCamera.cx);
  const geometry::CameraModel high = PictureCamera(kCamera, 480, 480);
  EXPECT_EQ(high.width, 480);
  EXPECT_EQ(high.cx, kCamera.cx - 80.0);
}

TEST(PictureCamera, StretchesNothing) {
  for (const auto& [width, height] : {std::pair(1280, 720), {1920, 1200}, {333, 777}, {640, 480}}) {
    const geometry::CameraModel picture =
        PictureCamera(kCamera, width, height).Resized(width, height);
    EXPECT_NEAR(picture.fx / picture.fy, kCamera.fx / kCamera.fy, 0.003) << width;
  }
}

}  // namespace
}  // namespace lararium::show
