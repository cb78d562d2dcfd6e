#include "player/benchmark/benchmark_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/player/benchmark_world.h"

namespace lararium::player {
namespace {

using geometry::Rigid3;
using ::testing::Optional;

// A sequence in which every frame is tracked exactly, until a test changes it.
class BenchmarkEvaluationTest : public ::testing::Test {
 protected:
  void Make(int frames, double noise = 0.0) {
    world_ = test::MakeBenchmarkWorld(frames, noise, 7);
    sequence_.name = "made";
    sequence_.points = world_.points;
    sequence_.images.clear();
    for (int i = 0; i < frames; ++i) {
      TrueImage image;
      image.file = std::to_string(i);
      image.camera = world_.camera;
      image.camera_from_world = world_.pairs[i].camera_from_world;
      sequence_.images.push_back(image);
    }
    answers_.resize(frames);
    for (int i = 0; i < frames; ++i) {
      answers_[i] = {.truth = &sequence_.images[i],
                     .time = i / 30.0,
                     .camera_from_map = world_.pairs[i].camera_from_map,
                     .followed = true,
                     .confidence = 1.0};
    }
  }
  void Lose(int frame) { answers_[frame].camera_from_map.reset(); }
  SequenceScore Score() const { return Evaluate(sequence_, answers_, landmarks_); }

  test::BenchmarkWorld world_;
  BenchmarkSequence sequence_;
  std::vector<FrameAnswer> answers_;
  std::vector<std::vector<Eigen::Vector3d>> landmarks_;
};

TEST(BenchmarkSummaryTest, QuantilesInterpolateBetweenSamples) {
  const Summary summary = Summarise({4, 1, 3, 2});
  EXPECT_EQ(summary.count, 4u);
  EXPECT_DOUBLE_EQ(summary.mean, 2.5);
  EXPECT_DOUBLE_EQ(summary.median, 2.5);
  EXPECT_DOUBLE_EQ(summary.p95, 3.85);
  EXPECT_DOUBLE_EQ(summary.max, 4.0);
  EXPECT_EQ(Summarise({}).count, 0u);
}

TEST(BenchmarkCalibrationTest, IsTheMeanGapBetweenConfidenceAndShareOfCorrectFrames) {
  Calibration calibration;
  EXPECT_EQ(calibration.Error(), 0.0);
  for (int i = 0; i < 10; ++i) {
    calibration.Add(0.85, i < 8);  // error 0.05
    calibration.Add(0.35, i < 1);  // error 0.25
  }
  EXPECT_NEAR(calibration.Error(), 0.15, 1e-12);
  Calibration other;
  other.Add(1.0, true);
  other.Add(calibration);
  EXPECT_EQ(other.count(), 21u);
  EXPECT_NEAR(other.Error(), 0.15 * 20 / 21, 1e-12);
}

TEST_F(BenchmarkEvaluationTest, ExactPosesHaveNoError) {
  Make(20);
  const SequenceScore score = Score();
  EXPECT_EQ(score.tracked, 20u);
  EXPECT_EQ(score.followed, 20u);
  EXPECT_EQ(score.false_accepts, 0u);
  EXPECT_LT(score.registration_px.max, 1e-6);
  EXPECT_LT(score.centre.max, 1e-8);
  EXPECT_LT(score.swimming_px, 1e-6);
  EXPECT_EQ(score.calibration.Error(), 0.0);
  EXPECT_FALSE(score.jitter_px);
  EXPECT_NEAR(score.lag_ms.value(), 0.0, 1e-6);
}

TEST_F(BenchmarkEvaluationTest, CountsOnlyVisibleFramesAsLost) {
  Make(20);
  for (int i = 4; i < 9; ++i) {
    Lose(i);
    sequence_.images[i].visible_fraction = i < 7 ? 0.2 : 0.9;
  }
  const SequenceScore score = Score();
  EXPECT_EQ(score.tracked, 15u);
  EXPECT_EQ(score.visible, 17u);
  EXPECT_EQ(score.visible_tracked, 15u);
  EXPECT_EQ(score.longest_loss, 2u);
  EXPECT_TRUE(score.recoveries.empty()) << "never fully covered";
}

TEST_F(BenchmarkEvaluationTest, ThePoseIsBackInOneFrameWhereTheFirstVisibleOneHasIt) {
  Make(30);
  for (const int i : {5, 6, 15, 16, 17, 28, 29}) {
    Lose(i);
  }
  for (const int i : {5, 6, 15, 28}) {
    sequence_.images[i].visible_fraction = 0.0;
  }
  const SequenceScore score = Score();
  ASSERT_EQ(score.recoveries.size(), 3u);
  EXPECT_EQ(score.recoveries[0].first_visible, 7u);
  EXPECT_EQ(score.recoveries[0].frames, 1u);
  EXPECT_EQ(score.recoveries[1].frames, 3u);
  EXPECT_TRUE(score.recoveries[1].found);
  EXPECT_FALSE(score.recoveries[2].found);
}

TEST_F(BenchmarkEvaluationTest, AWrongPoseIsAFalseAcceptAndNoRecovery) {
  Make(30);
  sequence_.images[9].visible_fraction = 0.0;
  answers_[9].camera_from_map->translation.x() += 1.0;  // a third of a metre in the map
  answers_[10].camera_from_map->translation.x() += 1.0;
  answers_[20].map = 1;
  const SequenceScore score = Score();
  EXPECT_EQ(score.false_accepts, 3u);
  EXPECT_EQ(score.blind_poses, 1u);
  ASSERT_EQ(score.recoveries.size(), 1u);
  EXPECT_EQ(score.recoveries[0].frames, 2u);
  EXPECT_EQ(score.errors.size(), 29u);
  EXPECT_LT(score.registration_px.median, 1e-6) << "two wrong poses do not move the alignment";
}

TEST_F(BenchmarkEvaluationTest, AnyPoseOfAPlaceWithoutTruthIsAFalseAccept) {
  Make(5);
  for (TrueImage& image : sequence_.images) {
    image.camera_from_world.reset();
  }
  Lose(0);
  EXPECT_EQ(Score().false_accepts, 4u);
}

TEST_F(BenchmarkEvaluationTest, PosesWithTheNoiseOfTheirCovarianceHaveANormalisedErrorOfOne) {
  Make(600);
  sequence_.points.resize(20);
  Eigen::Matrix<double, 6, 6> root = Eigen::Matrix<double, 6, 6>::Identity();
  root(4, 0) = 2.0;  // translation correlates with rotation, which is typical of distant points
  root *= 1e-4;
  Random random(11);
  for (FrameAnswer& answer : answers_) {
    Eigen::Matrix<double, 6, 1> unit;
    for (double& value : unit) {
      value = random.Normal();
    }
    const Eigen::Matrix<double, 6, 1> error = root * unit;
    answer.camera_from_map =
        Rigid3{geometry::RotationFromVector(error.head<3>()), error.tail<3>()} *
        *answer.camera_from_map;
    answer.covariance = root * root.transpose();
  }
  // The mean of 600 chi-squared variables of 6 degrees, over 6: 1 +- 0.024.
  const SequenceScore score = Score();
  EXPECT_NEAR(score.normalised_pose_error.mean, 1.0, 0.08);
  for (FrameAnswer& answer : answers_) {
    answer.covariance *= 4.0;
  }
  EXPECT_NEAR(Score().normalised_pose_error.mean, 0.25 * score.normalised_pose_error.mean, 1e-9);
  answers_[0].covariance.setZero();
  EXPECT_EQ(Score().normalised_pose_error.count, 599u);
}

TEST_F(BenchmarkEvaluationTest, PosesOfTheFrameBeforeLagByOneFrame) {
  // The camera moves sideways at a speed that rises and falls.
  Make(60);
  for (int i = 0; i < 60; ++i) {
    Rigid3 pose;
    pose.translation = {0.3 * std::sin(0.1 * i), 0.1 * std::cos(0.13 * i), 4.0};
    sequence_.images[i].camera_from_world = pose;
    answers_[i].camera_from_map = test::CameraFromMap(
        i == 0 ? pose : *sequence_.images[i - 1].camera_from_world, world_.world_from_map);
  }
  EXPECT_NEAR(Score().lag_ms.value(), 1000.0 / 30.0, 1.5);
}

TEST_F(BenchmarkEvaluationTest, JitterIsTheStrayingOfAStillCamera) {
  Make(400);
  const geometry::Similarity3 map_from_world = world_.world_from_map.Inverse();
  landmarks_.resize(1);
  for (int i = 0; i < 50; ++i) {
    landmarks_[0].push_back(map_from_world * world_.points[i]);
  }
  Random random(3);
  for (int i = 0; i < 400; ++i) {
    Rigid3 pose;
    pose.translation.z() = 4.0;
    sequence_.images[i].camera_from_world = pose;
    // The error is 0.1 px at the principal axis, along y only.
    const Rigid3 turn{geometry::RotationFromVector({0.1 / 500.0 * random.Normal(), 0.0, 0.0}),
                      Eigen::Vector3d::Zero()};
    answers_[i].camera_from_map = test::CameraFromMap(turn * pose, world_.world_from_map);
  }
  const SequenceScore score = Score();
  EXPECT_NEAR(score.jitter_px.value(), 0.1, 0.02);
  EXPECT_FALSE(score.lag_ms);
  EXPECT_EQ(score.registration_px.count, 0u) << "the scale of the map cannot be seen";
}

TEST_F(BenchmarkEvaluationTest, TheGainErrorForgivesTheReferenceItsOwnGain) {
  Make(11);
  for (int i = 0; i < 11; ++i) {
    sequence_.images[i].gain_ev = 0.1 * i;
    answers_[i].gain[1] = std::exp2(0.1 * i + 0.7);
  }
  answers_[5].gain[1] *= std::exp2(0.2);
  const Summary error = Score().gain_error_stops.value();
  EXPECT_NEAR(error.median, 0.0, 1e-9);
  EXPECT_NEAR(error.max, 0.2, 1e-9);
}

TEST_F(BenchmarkEvaluationTest, TimesAreApartForFollowedFoundAndMissedFrames) {
  Make(4);
  for (int i = 0; i < 4; ++i) {
    answers_[i].wall_ms = 10.0 * i;
    answers_[i].cpu_ms = 20.0 * i;
  }
  answers_[1].followed = false;
  Lose(3);
  const SequenceScore score = Score();
  EXPECT_EQ(score.followed_wall_ms.count, 2u);
  EXPECT_EQ(score.found_wall_ms.median, 10.0);
  EXPECT_EQ(score.found_cpu_ms.median, 20.0);
  EXPECT_EQ(score.missed_cpu_ms.median, 60.0);
}

}  // namespace
}  // namespace lararium::player
