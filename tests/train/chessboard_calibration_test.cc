#include "editor/train/chessboard_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/synthetic_board.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using test::BoardPicture;
using test::SyntheticBoard;
using ::testing::HasSubstr;
using Kind = CalibrationAdvice::Kind;

const CameraModel kCamera{640, 480, 560.0, 562.0, 325.0, 236.0, -0.28, 0.09, 0.0008, -0.0005};

std::vector<Eigen::Vector2d> Corners(const BoardPicture& picture, double noise, Random& random) {
  const SyntheticBoard board;
  std::vector<Eigen::Vector2d> corners;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const Eigen::Vector3d at(column * board.square, row * board.square, 0.0);
      corners.push_back(*kCamera.Project(picture.camera_from_board * at) +
                        noise * Eigen::Vector2d{random.Normal(), random.Normal()});
    }
  }
  return corners;
}

BoardCollector Collect(std::span<const BoardPicture> pictures, double noise, uint64_t seed = 1) {
  BoardCollector views({9, 6, 0.025}, kCamera.width, kCamera.height);
  Random random(seed);
  for (size_t i = 0; i < pictures.size(); ++i) {
    views.AddView({std::to_string(i), static_cast<int64_t>(i), 2.0 + pictures[i].smear_px,
                   Corners(pictures[i], noise, random)});
  }
  return views;
}

std::vector<BoardPicture> Varied(int count, uint64_t seed = 1) {
  return test::VariedBoardPictures({}, kCamera, count, seed);
}

Result<Calibration> CalibrateViews(const BoardCollector& views) {
  NoProgress progress;
  return Calibrate(views, progress);
}

bool Advises(const Calibration& calibration, Kind kind) {
  return std::any_of(calibration.advice.begin(), calibration.advice.end(),
                     [&](const CalibrationAdvice& advice) { return advice.kind == kind; });
}

TEST(Calibrate, FindsTheCameraThatSawTheCorners) {
  const auto found = CalibrateViews(Collect(Varied(30), 0.0));
  ASSERT_TRUE(found.ok()) << found.message();
  EXPECT_NEAR(found->camera.fx, kCamera.fx, 1e-2);
  EXPECT_NEAR(found->camera.fy, kCamera.fy, 1e-2);
  EXPECT_NEAR(found->camera.cx, kCamera.cx, 1e-2);
  EXPECT_NEAR(found->camera.cy, kCamera.cy, 1e-2);
  EXPECT_NEAR(found->camera.k1, kCamera.k1, 1e-4);
  EXPECT_NEAR(found->camera.k2, kCamera.k2, 3e-4);
  EXPECT_NEAR(found->camera.p1, kCamera.p1, 1e-5);
  EXPECT_NEAR(found->camera.p2, kCamera.p2, 1e-5);
  EXPECT_LT(found->rms_px, 1e-3);
}

TEST(Calibrate, SaysHowFarOffItIs) {
  double squares = 0.0;
  constexpr int kTrials = 2;
  for (uint64_t seed = 1; seed <= kTrials; ++seed) {
    const auto found = CalibrateViews(Collect(Varied(25, seed), 0.2, seed));
    ASSERT_TRUE(found.ok()) << found.message();
    const double fx = (found->camera.fx - kCamera.fx) / found->deviation.fx;
    const double k1 = (found->camera.k1 - kCamera.k1) / found->deviation.k1;
    squares += (fx * fx + k1 * k1) / (2.0 * kTrials);
    // OpenCV's RMS error covers both coordinates of a corner.
    EXPECT_NEAR(found->rms_px, 0.2 * std::sqrt(2.0), 0.03);
    EXPECT_NEAR(found->held_out_rms_px, 0.2 * std::sqrt(2.0), 0.06);
    EXPECT_EQ(found->held_out, (found->fitted + found->held_out) / 5);
    EXPECT_GE(found->fitted, 18);
  }
  EXPECT_GT(squares, 0.1);
  EXPECT_LT(squares, 2.5);
}

TEST(Calibrate, LeavesOutAViewThatFitsNoOther) {
  std::vector<BoardPicture> pictures = Varied(20);
  BoardCollector views({9, 6, 0.025}, kCamera.width, kCamera.height);
  Random random(3);
  for (size_t i = 0; i < pictures.size(); ++i) {
    std::vector<Eigen::Vector2d> corners = Corners(pictures[i], 0.1, random);
    if (i == 7) {  // The board bends.
      for (size_t c = 0; c < corners.size(); ++c) {
        corners[c].y() += 0.4 * std::pow(static_cast<double>(c % 9) - 4.0, 2.0);
      }
    }
    views.AddView({std::to_string(i), static_cast<int64_t>(i), 2.0, std::move(corners)});
  }
  const auto found = CalibrateViews(views);
  ASSERT_TRUE(found.ok()) << found.message();
  EXPECT_EQ(found->rejected, 1);
  EXPECT_EQ(found->views[7].part, CalibratedView::Part::kRejected);
  EXPECT_GT(found->views[7].rms_px, 1.0);
  EXPECT_NEAR(found->camera.fx, kCamera.fx, 0.005 * kCamera.fx);
}

TEST(Calibrate, NamesThePartsOfTheImageThatShowedNoBoard) {
  std::vector<BoardPicture> pictures = Varied(120);
  // Keeps the pictures in which the whole board is on the right.
  std::erase_if(pictures, [](const BoardPicture& picture) {
    return kCamera.Project(picture.camera_from_board * Eigen::Vector3d::Zero())->x() < 230.0 ||
           kCamera.Project(picture.camera_from_board * Eigen::Vector3d(0.0, 0.125, 0.0))->x() <
               230.0;
  });
  pictures.resize(std::min<size_t>(pictures.size(), 25));
  const auto found = CalibrateViews(Collect(pictures, 0.1));
  ASSERT_TRUE(found.ok()) << found.message();
  std::vector<int> parts;
  for (const CalibrationAdvice& advice : found->advice) {
    if (advice.kind == Kind::kPart) {
      parts.push_back(static_cast<int>(advice.value));
    }
  }
  EXPECT_THAT(parts, ::testing::ElementsAre(0, 6, 3));
  EXPECT_NE(found->verdict, Calibration::Verdict::kGood);
}

TEST(Calibrate, LeavesOutBlurredViewsAndSaysHowMany) {
  std::vector<BoardPicture> pictures = Varied(24);
  std::vector<BoardPicture> sharp;
  for (size_t i = 0; i < pictures.size(); ++i) {
    if (i % 3 == 0) {
      pictures[i].smear_px = 6.0;
    } else {
      sharp.push_back(pictures[i]);
    }
  }
  const auto found = CalibrateViews(Collect(pictures, 0.1));
  const auto without = CalibrateViews(Collect(sharp, 0.1));
  ASSERT_TRUE(found.ok()) << found.message();
  ASSERT_TRUE(without.ok()) << without.message();
  EXPECT_EQ(found->counts.blurred, 8);
  EXPECT_EQ(found->fitted + found->held_out, without->fitted + without->held_out);
  EXPECT_TRUE(Advises(*found, Kind::kBlur));
}

TEST(Calibrate, RefusesBoardsThatAreAllParallelToTheImage) {
  std::vector<BoardPicture> pictures;
  for (int i = 0; i < 24; ++i) {
    BoardPicture picture;
    picture.camera_from_board = test::AimedBoardPose(
        {}, kCamera, {640 * (0.3 + 0.1 * (i % 5)), 480 * (0.35 + 0.1 * (i / 5 % 3))},
        0.35 + 0.05 * (i % 4), 0.0, 0.0, 0.0);
    pictures.push_back(picture);
  }
  const auto found = CalibrateViews(Collect(pictures, 0.1));
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.message(), HasSubstr("nearly one angle"));
  EXPECT_THAT(found.message(), HasSubstr("tilt it"));
}

TEST(Calibrate, RefusesOnePoseHoweverOftenItWasSeen) {
  const auto found =
      CalibrateViews(Collect(std::vector<BoardPicture>(100, Varied(1).front()), 0.1));
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.message(), HasSubstr("seen in 100 of 100 images, but always in one place"));
}

TEST(Calibrate, RefusesTooFewViews) {
  const auto found = CalibrateViews(Collect(Varied(5), 0.1));
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.message(), HasSubstr("in only 5 ways; 8 that differ are needed"));
}

TEST(BoardCollector, KeepsVariedViewsOfManyAndTheSharpestOfThoseAlike) {
  std::vector<BoardPicture> pictures = Varied(150);
  std::vector<BoardPicture> twice = pictures;  // Each picture again, sharper.
  for (BoardPicture& picture : pictures) {
    picture.smear_px = 0.5;
  }
  pictures.insert(pictures.end(), twice.begin(), twice.end());
  const BoardCollector views = Collect(pictures, 0.0);
  const std::vector<BoardView> chosen = views.Chosen();
  EXPECT_EQ(chosen.size(), BoardCollector::kMostViews);
  for (const BoardView& view : chosen) {
    EXPECT_EQ(view.blur_px, 2.0) << view.name;
  }
  EXPECT_EQ(views.counts().found, 300);
}

TEST(Board, RefusesSizesThatNoBoardHas) {
  EXPECT_TRUE(Board().Validate().ok());
  EXPECT_THAT((Board{2, 6}).Validate().message(), HasSubstr("where four squares meet"));
  EXPECT_FALSE((Board{9, 100}).Validate().ok());
  EXPECT_FALSE((Board{9, 6, -0.1}).Validate().ok());
}

TEST(CalibrateFromBoard, SaysThatNothingWasFoundOrWhichBoardWasThere) {
  NoProgress progress;
  const CameraModel small = kCamera.Resized(320, 240);
  std::vector<BoardPicture> pictures(2, Varied(1).front());
  test::BoardRecording recording({}, small, pictures);
  const auto other = CalibrateFromBoard(recording, {10, 7}, 1.0, progress);
  EXPECT_THAT(other.message(), HasSubstr("in none of 2 images, but a board 9x6 was"));
  for (BoardPicture& picture : pictures) {
    picture.board = false;
  }
  test::BoardRecording empty({}, small, pictures);
  const auto none = CalibrateFromBoard(empty, {9, 6}, 1.0, progress);
  EXPECT_THAT(none.message(), HasSubstr("in none of 2 images; count inner corners"));
}

TEST(FindBoard, FindsNoneInAnImageThatIsTooSmall) {
  EXPECT_FALSE(FindBoard(cv::Mat(4, 4, CV_8U, cv::Scalar(0)), {}).has_value());
}

TEST(CalibrateFromBoard, EndsWhenItIsCancelled) {
  class Cancelling : public Progress {
   public:
    void Report(std::string_view, double) override {}
    bool Cancelled() const override { return true; }
  };
  Cancelling progress;
  test::BoardRecording recording({}, kCamera.Resized(64, 48), Varied(2));
  EXPECT_THAT(CalibrateFromBoard(recording, {}, 1.0, progress).message(), HasSubstr("cancelled"));
}

}  // namespace
}  // namespace lararium::train
