#include "editor/panels/viewport/image_view.h"

#include <gtest/gtest.h>

#include "shared/core/random.h"

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr geometry::CameraModel kRaw{640,   480,   520.0, 515.0,  322.4,
                                     236.1, -0.21, 0.06,  0.0011, -0.0007};

TEST(ImageView, APointOfThePlaceIsWhereThePictureShowsItAndGivesItsRawPixel) {
  const ImageView map{{37.5, 12.25}, 1.7, ImageView::Redrawn{kRaw, kRaw.DisplayPinhole()}};
  Random random(3);
  double farthest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d point{random.Uniform(-1.0, 1.0), random.Uniform(-0.75, 0.75),
                         random.Uniform(2.0, 6.0)};
    const Vector2d raw = *kRaw.Project(point);
    const Vector2d shown = *map.redrawn->display.Project(point);
    const Vector2d on_screen = map.origin + 1.7 * (shown + Vector2d(0.5, 0.5));
    EXPECT_LT((map.ToScreen(raw) - on_screen).norm(), 1e-6);
    EXPECT_LT((map.ToPixel(on_screen) - raw).norm(), 1e-6);
    farthest = std::max(farthest, (raw - shown).norm());
  }
  EXPECT_GT(farthest, 3.0) << "the two cameras hardly differ";
}

TEST(ImageView, WithoutAnotherCameraThePictureIsTheImage) {
  const ImageView map{{10.0, 20.0}, 0.5};
  EXPECT_EQ(map.ToScreen({0.0, 0.0}), Vector2d(10.25, 20.25));
  EXPECT_EQ(map.ToPixel({10.25, 20.25}), Vector2d(0.0, 0.0));
  EXPECT_EQ(map.ToPicture({7.0, 8.0}), Vector2d(7.0, 8.0));
}

}  // namespace
}  // namespace lararium::panels
