// Tests the whole calibration from pictures; drawing and searching them takes seconds.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <string>
#include <vector>

#include "editor/train/chessboard_calibration.h"
#include "shared/capture/frame_source.h"
#include "tests/support/synthetic_board.h"
#include "tests/support/test_files.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;

// The 95 % quantile of the difference between the distortions of two cameras over the image,
// pixels. In the image's corners, which a whole board seldom reaches, distortion is extrapolated.
double DistortionError(const CameraModel& a, const CameraModel& b) {
  CameraModel bent = b;
  bent.k1 = a.k1;
  bent.k2 = a.k2;
  bent.p1 = a.p1;
  bent.p2 = a.p2;
  std::vector<double> errors;
  for (int y = 0; y < b.height; y += 10) {
    for (int x = 0; x < b.width; x += 10) {
      const Eigen::Vector2d pixel(x, y);
      errors.push_back((bent.PixelFromPlane(b.PlaneFromPixel(pixel)) - pixel).norm());
    }
  }
  const auto quantile = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 95 / 100);
  std::nth_element(errors.begin(), quantile, errors.end());
  return *quantile;
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
  EXPECT_LT(DistortionError(found->camera, camera), 0.15);
  EXPECT_LT(found->rms_px, 0.15);
  EXPECT_LT(found->held_out_rms_px, 0.2);
  EXPECT_LT(std::abs(found->camera.fx - camera.fx), 3.5 * found->deviation.fx);
  EXPECT_GE(found->counts.blurred, 4);
  EXPECT_EQ(found->verdict, Calibration::Verdict::kGood);
  EXPECT_GT(found->covered, 0.6);
  // Distances are in metres; the nearest board fills the image.
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

// A printed, hand-held board, photographed by two cameras on one bar at the same moments.
class CalibrateFromPhotographs : public ::testing::Test {
 protected:
  static constexpr Board kBoard = {9, 6, 0.025};

  void SetUp() override {
    if (!std::filesystem::exists(test::BoardPhotographsDir() / ".complete")) {
      GTEST_SKIP() << "needs scripts/fetch_board_photographs.sh";
    }
  }

  static Calibration CalibrateCamera(const char* side) {
    NoProgress progress;
    auto photographs = capture::OpenImageFolder(test::BoardPhotographsDir() / side);
    EXPECT_TRUE(photographs.ok()) << photographs.message();
    auto found = CalibrateFromBoard(**photographs, kBoard, 1.0, progress);
    EXPECT_TRUE(found.ok()) << found.message();
    return *std::move(found);
  }

  // Poses of the board by the number of the photograph, without rejected views.
  static std::map<std::string, geometry::Rigid3> BoardPoses(const Calibration& calibration) {
    std::map<std::string, geometry::Rigid3> poses;
    for (const CalibratedView& seen : calibration.views) {
      if (seen.part == CalibratedView::Part::kRejected) {
        continue;
      }
      std::vector<cv::Point3d> board;
      std::vector<cv::Point2d> plane;
      for (const Eigen::Vector2d& corner : seen.view.corners) {
        const auto index = static_cast<int>(board.size());
        board.emplace_back(kBoard.square * (index % kBoard.columns),
                           kBoard.square * (index / kBoard.columns), 0.0);
        const Eigen::Vector2d at = calibration.camera.PlaneFromPixel(corner);
        plane.emplace_back(at.x(), at.y());
      }
      cv::Vec3d turn;
      cv::Vec3d shift;
      EXPECT_TRUE(cv::solvePnP(board, plane, cv::Matx33d::eye(), cv::noArray(), turn, shift));
      const Eigen::Vector3d axis(turn[0], turn[1], turn[2]);
      const std::string number = seen.view.name.substr(seen.view.name.find_first_of("0123456789"));
      poses[number] = {Eigen::Quaterniond(Eigen::AngleAxisd(axis.norm(), axis.normalized())),
                       {shift[0], shift[1], shift[2]}};
    }
    return poses;
  }
};

TEST_F(CalibrateFromPhotographs, FindsTheCameraThatOthersFoundFromTheSamePhotographs) {
  const Calibration left = CalibrateCamera("left");
  cv::FileStorage theirs((test::BoardPhotographsDir() / "left_intrinsics.yml").string(),
                         cv::FileStorage::READ);
  ASSERT_TRUE(theirs.isOpened());
  cv::Mat matrix;
  theirs["camera_matrix"] >> matrix;
  EXPECT_NEAR(left.camera.fx, matrix.at<double>(0, 0), 0.005 * left.camera.fx);
  EXPECT_NEAR(left.camera.cx, matrix.at<double>(0, 2), 3.0 * left.deviation.cx);
  EXPECT_NEAR(left.camera.cy, matrix.at<double>(1, 2), 3.0 * left.deviation.cy);
  EXPECT_EQ(left.counts.found, 13);
  EXPECT_LT(left.rms_px, 0.3);
  EXPECT_LT(left.held_out_rms_px, 0.4);
  EXPECT_LT(left.FocalDeviation(), 0.005);
}

// The bar is stiff, which the calibration does not know.
TEST_F(CalibrateFromPhotographs, BothCamerasKeepTheirDistanceInAllPhotographs) {
  const auto left = BoardPoses(CalibrateCamera("left"));
  const auto right = BoardPoses(CalibrateCamera("right"));
  std::vector<geometry::Rigid3> right_from_left;
  for (const auto& [number, left_from_board] : left) {
    if (const auto found = right.find(number); found != right.end()) {
      right_from_left.push_back(found->second * left_from_board.Inverse());
    }
  }
  ASSERT_GE(right_from_left.size(), 9u);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const geometry::Rigid3& pose : right_from_left) {
    mean += pose.Center() / static_cast<double>(right_from_left.size());
  }
  double squares = 0.0;
  for (const geometry::Rigid3& pose : right_from_left) {
    squares += (pose.Center() - mean).squaredNorm() / static_cast<double>(right_from_left.size());
    EXPECT_LT(pose.rotation.angularDistance(right_from_left.front().rotation), 0.01);
  }
  EXPECT_NEAR(mean.norm(), 0.084, 0.002);
  EXPECT_LT(std::sqrt(squares), 0.0015);
}

}  // namespace
}  // namespace lararium::train
