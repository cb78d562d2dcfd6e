#include "player/app/picture_output.h"

#include <gtest/gtest.h>

namespace lararium::player {
namespace {

constexpr geometry::CameraModel kCamera{641, 480, 560.0, 560.0, 320.0, 239.5};

Headset HeadsetWithPanel() {
  geometry::LensModel lens{400, 360, 340.0, 340.0, 210.0, 170.0};
  Headset headset;
  headset.panel = Panel{{lens, lens.Mirrored()}};
  return headset;
}

TEST(ChooseLayout, WithoutAHeadsetPicturesHaveTheEvenSizeOfTheCamerasImages) {
  const PictureLayout layout = ChooseLayout({}, std::nullopt, kCamera).value();
  EXPECT_FALSE(layout.headset.has_value());
  EXPECT_EQ(layout.camera, kCamera);
  EXPECT_EQ(layout.size.width, 640);
  EXPECT_EQ(layout.size.height, 480);
}

TEST(ChooseLayout, TheSizeThatIsGivenGoesBeforeThatOfTheCamera) {
  DisplayOptions options;
  options.size = PictureSize{320, 240};
  EXPECT_EQ(ChooseLayout(options, std::nullopt, kCamera)->size.width, 320);
}

TEST(ChooseLayout, APanelIsUsedUnlessTheOptionsSayOtherwise) {
  const Headset headset = HeadsetWithPanel();
  EXPECT_TRUE(ChooseLayout({}, headset, kCamera)->headset->panel.has_value());
  DisplayOptions options;
  options.mode = Display::kMono;
  EXPECT_FALSE(ChooseLayout(options, headset, kCamera)->headset.has_value());
  options.mode = Display::kOpenXr;
  EXPECT_FALSE(ChooseLayout(options, headset, kCamera)->headset->panel.has_value())
      << "the runtime knows the panel";
}

TEST(ChooseLayout, SideBySideNeedsAPanel) {
  DisplayOptions options;
  options.mode = Display::kSideBySide;
  EXPECT_NE(ChooseLayout(options, std::nullopt, kCamera).message().find("--device"),
            std::string::npos);
  EXPECT_FALSE(ChooseLayout(options, Headset(), kCamera).ok());
  EXPECT_TRUE(ChooseLayout(options, HeadsetWithPanel(), kCamera).ok());
}

}  // namespace
}  // namespace lararium::player
