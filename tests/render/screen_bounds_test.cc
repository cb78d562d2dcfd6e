#include "shared/render/passes/screen_bounds.h"

#include <gtest/gtest.h>

#include "shared/render/clip_space.h"

namespace lararium::render {
namespace {

const geometry::CameraModel kBoundsDisplay = {
    .width = 200, .height = 100, .fx = 150, .fy = 150, .cx = 99.5, .cy = 49.5};

TEST(ScreenBounds, HoldEveryPixelOfTheBoxAndLittleMore) {
  const glm::mat4 clip_from_camera = ClipFromCamera(kBoundsDisplay, 0.1f, 50.0f);
  Box box;
  box.Extend({-0.2f, -0.1f, 2.0f});
  box.Extend({0.3f, 0.2f, 2.5f});
  ScreenBounds screen;
  screen.Extend(box, clip_from_camera);
  const PixelBounds bounds = screen.Pixels(kBoundsDisplay.width, kBoundsDisplay.height);
  // x: 99.5 - 15 .. 99.5 + 22.5; y from the top: 49.5 - 7.5 .. 49.5 + 15.
  EXPECT_NEAR(bounds.left, 84, 2);
  EXPECT_NEAR(bounds.right, 123, 2);
  EXPECT_NEAR(bounds.top, 100 - 42, 2);
  EXPECT_NEAR(bounds.bottom, 100 - 65, 2);
  EXPECT_LE(bounds.left, 84);
  EXPECT_GE(bounds.right, 123);
}

TEST(ScreenBounds, AreEverythingWhenTheBoxReachesBehindTheViewer) {
  Box box;
  box.Extend({-0.2f, -0.1f, -1.0f});
  box.Extend({0.3f, 0.2f, 2.5f});
  ScreenBounds screen;
  screen.Extend(box, ClipFromCamera(kBoundsDisplay, 0.1f, 50.0f));
  const PixelBounds bounds = screen.Pixels(kBoundsDisplay.width, kBoundsDisplay.height);
  EXPECT_EQ(bounds.width(), kBoundsDisplay.width);
  EXPECT_EQ(bounds.height(), kBoundsDisplay.height);
}

TEST(ScreenBounds, AreEmptyWhereAllOfTheBoxIsBehindTheViewer) {
  Box box;
  box.Extend({-0.2f, -0.1f, -2.0f});
  box.Extend({0.3f, 0.2f, -1.0f});
  ScreenBounds screen;
  screen.Extend(box, ClipFromCamera(kBoundsDisplay, 0.1f, 50.0f));
  EXPECT_TRUE(screen.Pixels(kBoundsDisplay.width, kBoundsDisplay.height).empty());
}

TEST(ScreenBounds, AreEmptyForNothingAndForWhatIsOutside) {
  ScreenBounds screen;
  EXPECT_TRUE(screen.Pixels(200, 100).empty());
  screen.Extend(Box(), ClipFromCamera(kBoundsDisplay, 0.1f, 50.0f));
  EXPECT_TRUE(screen.Pixels(200, 100).empty());
  Box box;
  box.Extend({20.0f, 0.0f, 2.0f});
  box.Extend({21.0f, 1.0f, 2.0f});
  screen.Extend(box, ClipFromCamera(kBoundsDisplay, 0.1f, 50.0f));
  EXPECT_TRUE(screen.Pixels(200, 100).empty());
}

}  // namespace
}  // namespace lararium::render
