// The way from pictures to intrinsics; drawing and searching them takes seconds.

#include <gtest/gtest.h>

#include <cmath>

#include "editor/train/chessboard_calibration.h"
#include "tests/support/synthetic_board.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;

// How far the lenses of both bend a pixel differently, at most.
double WorstDistortion(const CameraModel& a, const CameraModel& b) {
  CameraModel bent = b;
  bent.k1 = a.k1;
  bent.k2 = a.k2;
  bent.p1 = a.p1;
  bent.p2 = a.p2;
  double worst = 0.0;
  for (int y = 0; y < b.height; y += 10) {
    for (int x = 0; x < b.width; x += 10) {
      const Eigen::Vector2d pixel(x, y);
      worst = std::max(worst, (bent.PixelFromPlane(b.PlaneFromPixel(pixel)) - pixel).norm());
    }
  }
  return worst;
}

class CalibrateFromPictures : public ::testing::TestWithParam<CameraModel> {};

TEST_P(CalibrateFromPictures, FindsTheCameraThroughNoiseBlurAndDistortion) {
  const CameraModel& camera = GetParam();
  const test::SyntheticBoard board;
  std::vector<test::BoardPicture> pictures = test::VariedBoardPictures(board, camera, 50, 1);
  for (size_t i = 0; i < pictures.size(); ++i) {
    pictures[i].blur_px = 0.6 + 0.1 * static_cast<double>(i % 4);
    pictures[i].noise = 4.0;
    pictures[i].smear_px = i % 10 == 9 ? 12.0 : 0.0;
  }
  test::BoardRecording recording(board, camera, pictures);
  NoProgress progress;
  const auto found = CalibrateFromBoard(recording, {9, 6, 0.025}, 1.0, progress);
  ASSERT_TRUE(found.ok()) << found.message();
  EXPECT_NEAR(found->camera.fx, camera.fx, 0.002 * camera.fx);
  EXPECT_NEAR(found->camera.fy, camera.fy, 0.002 * camera.fy);
  EXPECT_NEAR(found->camera.cx, camera.cx, 1.0);
  EXPECT_NEAR(found->camera.cy, camera.cy, 1.0);
  EXPECT_LT(WorstDistortion(found->camera, camera), 0.3);
  EXPECT_LT(found->rms_px, 0.15);
  EXPECT_LT(found->held_out_rms_px, 0.2);
  EXPECT_LT(std::abs(found->camera.fx - camera.fx), 3.5 * found->deviation.fx);
  EXPECT_GE(found->counts.blurred, 4);
  EXPECT_EQ(found->verdict, Calibration::Verdict::kGood);
  EXPECT_GT(found->covered, 0.6);
  // Metres: the nearest board fills the image.
  for (const CalibratedView& view : found->views) {
    if (view.part == CalibratedView::Part::kRejected) {
      continue;
    }
    EXPECT_GT(view.distance, 0.15);
    EXPECT_LT(view.distance, 1.5);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cameras,
    CalibrateFromPictures,
    ::testing::Values(CameraModel{640, 480, 560, 562, 325, 236, -0.28, 0.09, 0.0008, -0.0005},
                      CameraModel{960, 540, 760, 758, 470, 275, 0.06, -0.10, 0.0, 0.0}));

}  // namespace
}  // namespace lararium::train
