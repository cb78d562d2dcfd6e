#include "shared/show/camera_look.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lararium::show {
namespace {

constexpr geometry::CameraModel kCamera = {640, 480, 500.0, 500.0, 319.5, 239.5};

StagedFrame Staged() {
  StagedFrame staged;
  staged.tracked.camera = kCamera;
  staged.tracked.frame.index = 12;
  staged.tracked.shutter = 0.5f;
  staged.camera.motion = CameraMotion{geometry::Rigid3(), 1};
  return staged;
}

const light::CameraTraits kTraits = {640, 0.01f, 0.001f, 0.8f};

TEST(LookOf, IsThatOfTheCameraAtItsOwnSize) {
  const render::CameraLook look = LookOf(kTraits, Staged(), kCamera);
  EXPECT_EQ(look.noise_floor, 0.01f);
  EXPECT_EQ(look.noise_slope, 0.001f);
  EXPECT_NEAR(look.blur_px, 0.8f, 1e-6f);
  EXPECT_EQ(look.frame, 12u);
  EXPECT_EQ(look.shutter, 0.5f);
  EXPECT_TRUE(look.previous_camera_from_stage.has_value());
}

TEST(LookOf, BlurGoesWithThePixelsOfThePicture) {
  // At twice the size, the lens's blur and the camera's pixels are twice as large.
  const render::CameraLook large = LookOf(kTraits, Staged(), kCamera.Resized(1280, 960));
  EXPECT_NEAR(large.blur_px, std::sqrt(1.6 * 1.6 + 0.25), 1e-5);
  const render::CameraLook small = LookOf(kTraits, Staged(), kCamera.Resized(320, 240));
  EXPECT_NEAR(small.blur_px, 0.4, 1e-5);
  // The traits were measured on images of another size.
  light::CameraTraits fine = kTraits;
  fine.width = 1280;
  EXPECT_NEAR(LookOf(fine, Staged(), kCamera).blur_px, 0.4, 1e-5);
}

TEST(LookOf, TheShutterIsThatOfTheTraitsElseTheOneThatWasLearnt) {
  light::CameraTraits known = kTraits;
  known.shutter = 0.25f;
  StagedFrame staged = Staged();
  EXPECT_EQ(LookOf(known, staged, kCamera).shutter, 0.25f);
  staged.camera.motion->frames = 2;  // The motion spans two frames.
  EXPECT_EQ(LookOf(known, staged, kCamera).shutter, 0.125f);
  staged.tracked.shutter.reset();
  EXPECT_EQ(LookOf(kTraits, staged, kCamera).shutter, 0.0f);
  staged.camera.motion.reset();
  EXPECT_FALSE(LookOf(known, staged, kCamera).previous_camera_from_stage.has_value());
}

}  // namespace
}  // namespace lararium::show
