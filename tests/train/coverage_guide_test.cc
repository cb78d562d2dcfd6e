// Tests the advice for a simulated camera in a room with corners all around it.

#include "editor/train/coverage_guide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "shared/core/random.h"
#include "shared/core/units.h"
#include "shared/geometry/transform.h"

namespace lararium::train {
namespace {

using Eigen::Vector3d;
constexpr double kRate = 10.0;  // frames per second
constexpr double kFocal = 280.0;
constexpr double kHalfWidth = 160.0;
constexpr double kHalfHeight = 120.0;

// Position (metres; x right, z ahead of the first view) and viewing direction of the camera.
struct Stand {
  double x = 0.0;
  double z = 0.0;
  double yaw = 0.0;    // Radians to the right.
  double pitch = 0.0;  // Radians upwards.
};

class CoverageGuideTest : public testing::Test {
 protected:
  CoverageGuideTest() {
    Random random(6);
    for (int i = 0; i < 6000; ++i) {
      // Walls at about three metres, the floor, and furniture in front of them.
      const double yaw = random.Uniform(-std::numbers::pi, std::numbers::pi);
      const double distance = random.Uniform(1.8, 4.5);
      points_.push_back(
          {distance * std::sin(yaw), random.Uniform(-1.2, 1.6), distance * std::cos(yaw)});
    }
    seen_.assign(points_.size(), -2);
    ids_.assign(points_.size(), 0);
  }

  CoverageFrame Look(const Stand& stand) {
    const Eigen::Quaterniond world_from_camera = Eigen::AngleAxisd(stand.yaw, Vector3d::UnitY()) *
                                                 Eigen::AngleAxisd(stand.pitch, Vector3d::UnitX());
    CoverageFrame frame;
    frame.time = number_ / kRate;
    frame.shift = 0.01;
    frame.sharpness = 100.0;
    CoverageFeatures features;
    for (size_t i = 0; i < points_.size(); ++i) {
      const Vector3d in_camera =
          world_from_camera.conjugate() * (points_[i] - Vector3d(stand.x, 0.0, stand.z));
      const Eigen::Vector2d pixel = kFocal * in_camera.hnormalized() +
                                    0.2 * Eigen::Vector2d{noise_.Normal(), noise_.Normal()};
      const bool inside = in_camera.z() > 0.2 && std::abs(pixel.x()) < kHalfWidth &&
                          std::abs(pixel.y()) < kHalfHeight;
      if (!inside) {
        continue;
      }
      if (seen_[i] != number_ - 1) {
        ids_[i] = next_id_++;  // A lost corner gets a new id.
      }
      seen_[i] = number_;
      frame.tracks.push_back({ids_[i], pixel / assumed_focal_});
      if (describes_ && i % 3 == 0) {
        features.on_plane.push_back(pixel / assumed_focal_);
        features.descriptors.push_back(DescriptorOf(i));
      }
    }
    frame.describe = [features] { return features; };
    ++number_;
    return frame;
  }

  // The descriptor of a point is the same in all frames.
  static vision::Descriptor DescriptorOf(size_t point) {
    Random random(1000 + point);
    vision::Descriptor descriptor;
    for (uint8_t& value : descriptor) {
      value = static_cast<uint8_t>(random.Below(256));
    }
    return descriptor;
  }

  // Walks to a stand in the given number of frames.
  CoverageState Go(const Stand& to, int frames) {
    CoverageState state;
    for (int i = 1; i <= frames; ++i) {
      const double share = static_cast<double>(i) / frames;
      const auto between = [&](double a, double b) { return a + share * (b - a); };
      state = guide_.Add(Look({between(at_.x, to.x), between(at_.z, to.z), between(at_.yaw, to.yaw),
                               between(at_.pitch, to.pitch)}));
    }
    at_ = to;
    return state;
  }

  std::vector<Vector3d> points_;
  std::vector<int> seen_;
  std::vector<uint32_t> ids_;
  Random noise_{9};
  uint32_t next_id_ = 0;
  int number_ = 0;
  double assumed_focal_ = kFocal;
  bool describes_ = false;  // Frames have features, so views can be recognised.
  Stand at_;
  CoverageGuide guide_{Eigen::Vector2d(kHalfWidth, kHalfHeight) / kFocal};
};

TEST_F(CoverageGuideTest, StandingStillCoversNothingAndIsTold) {
  CoverageState state;
  for (int i = 0; i < 40; ++i) {
    CoverageFrame frame = Look({});
    frame.shift = 0.0002;
    state = guide_.Add(frame);
  }
  EXPECT_EQ(state.fault, CoverageFault::kStanding);
  EXPECT_EQ(state.shares.all(), 0.0);
  EXPECT_LT(state.moved.norm(), 0.02);
}

TEST_F(CoverageGuideTest, TurningOnTheSpotSeesButDoesNotCoverAndIsTold) {
  for (const double focal : {kFocal, 1.2 * kFocal}) {
    assumed_focal_ = focal;
    guide_ = CoverageGuide(Eigen::Vector2d(kHalfWidth, kHalfHeight) / focal);
    Go({.yaw = 35.0 * kRadiansPerDegree}, 40);
    const CoverageState state = Go({.yaw = -5.0 * kRadiansPerDegree}, 40);
    EXPECT_EQ(state.fault, CoverageFault::kTurning) << focal;
    EXPECT_EQ(state.shares.ahead, 0.0) << focal;
    EXPECT_LT(state.shares.sideways, 0.1) << focal;
    const auto& level = guide_.cells()[1];
    EXPECT_EQ(level[12], CoverageGuide::Cell::kSeen) << "just right of the beginning";
    EXPECT_EQ(level[2], CoverageGuide::Cell::kUnseen) << "behind it";
  }
}

TEST_F(CoverageGuideTest, MeasuresHeadingAndSteps) {
  Go({.x = 0.9, .yaw = 20.0 * kRadiansPerDegree}, 60);
  const CoverageState state = Go({.x = 0.9, .z = 0.6, .yaw = 20.0 * kRadiansPerDegree}, 40);
  // The tolerance is well within a column.
  EXPECT_NEAR(state.heading, 20.0 * kRadiansPerDegree, 4.0 * kRadiansPerDegree);
  EXPECT_NEAR(state.pitch, 0.0, 4.0 * kRadiansPerDegree);
  // The corners are about three metres away.
  EXPECT_NEAR(state.moved.x(), 0.3, 0.1);
  EXPECT_NEAR(state.moved.y(), 0.2, 0.1);
}

TEST_F(CoverageGuideTest, SteppingAsideCoversWhatIsAhead) {
  const CoverageState state = Go({.x = 0.9}, 50);
  EXPECT_EQ(state.fault, CoverageFault::kNone);
  EXPECT_EQ(guide_.cells()[1][12], CoverageGuide::Cell::kCovered);
  EXPECT_GT(state.shares.ahead, 0.3);
  EXPECT_LT(state.shares.ahead, 1.0) << "the sides were not looked at";
}

TEST_F(CoverageGuideTest, ASideThatIsMissingIsAskedFor) {
  Go({.x = 0.9}, 50);
  Go({.x = 0.9, .yaw = 40.0 * kRadiansPerDegree}, 30);
  Go({.x = -0.5, .yaw = 40.0 * kRadiansPerDegree}, 60);
  const CoverageState state = Go({.x = -0.5}, 30);
  EXPECT_TRUE(state.advice == CoverageAdvice::kLookLeft ||
              state.advice == CoverageAdvice::kStepLeft)
      << static_cast<int>(state.advice);
  EXPECT_EQ(guide_.cells()[1][14], CoverageGuide::Cell::kCovered);
}

// The walls of the room end each step that would lead through them.
class CoverageWalkTest : public CoverageGuideTest, public testing::WithParamInterface<uint64_t> {};

TEST_P(CoverageWalkTest, ThatDoesWhatIsAskedComesToItsEnd) {
  noise_ = Random(GetParam());
  double covered = 0.0;
  CoverageState state = Go({}, 2);
  int steps = 0;
  for (; steps < 60 && state.advice != CoverageAdvice::kEnough; ++steps) {
    Stand to = at_;
    switch (state.advice) {
      case CoverageAdvice::kStepLeft:
        to.x -= 0.2;
        break;
      case CoverageAdvice::kStepRight:
        to.x += 0.2;
        break;
      case CoverageAdvice::kLookLeft:
        to.yaw -= 10.0 * kRadiansPerDegree;
        break;
      case CoverageAdvice::kLookRight:
        to.yaw += 10.0 * kRadiansPerDegree;
        break;
      case CoverageAdvice::kLookDown:
        to.pitch -= 10.0 * kRadiansPerDegree;
        break;
      case CoverageAdvice::kGoNearer:
        to.z += 0.2;
        break;
      case CoverageAdvice::kStepBack:
        to.z -= 0.2;
        break;
      case CoverageAdvice::kEnough:
        break;
    }
    to.x = std::clamp(to.x, -1.2, 1.2);
    to.z = std::clamp(to.z, -0.8, 0.8);
    state = Go(to, 10);
    EXPECT_GE(state.shares.all(), covered - 1e-9) << "what is covered stays so";
    covered = state.shares.all();
  }
  EXPECT_EQ(state.advice, CoverageAdvice::kEnough);
  EXPECT_EQ(state.shares.all(), 1.0);
  EXPECT_GT(steps, 10) << "a glance is not enough";
}

INSTANTIATE_TEST_SUITE_P(Noise, CoverageWalkTest, testing::Values(1, 3, 6, 8, 9, 11));

TEST_F(CoverageGuideTest, BlurHasteDarknessAndBareWallsAreToldFirst) {
  Go({.x = 0.3}, 20);
  const auto fault = [&](const std::function<void(CoverageFrame&)>& spoil) {
    CoverageFrame frame = Look(at_);
    spoil(frame);
    return guide_.Add(frame).fault;
  };
  EXPECT_EQ(fault([](CoverageFrame&) {}), CoverageFault::kNone);
  EXPECT_EQ(fault([](CoverageFrame& f) { f.sharpness = 20.0; }), CoverageFault::kBlurred);
  EXPECT_EQ(fault([](CoverageFrame& f) { f.shift = 0.1; }), CoverageFault::kFast);
  EXPECT_EQ(fault([](CoverageFrame& f) { f.brightness = 0.05; }), CoverageFault::kDark);
  EXPECT_EQ(fault([](CoverageFrame& f) { f.clipped = 0.5; }), CoverageFault::kBright);
  EXPECT_EQ(fault([](CoverageFrame& f) { f.tracks.resize(8); }), CoverageFault::kBare);
}

TEST_F(CoverageGuideTest, GoesOnAfterAllCornersWereLost) {
  Go({.x = 0.5}, 30);
  CoverageFrame lost = Look(at_);
  lost.tracks.clear();
  EXPECT_EQ(guide_.Add(lost).fault, CoverageFault::kBare);
  number_ += 2;  // All corners get new ids.
  const CoverageState before = guide_.Add(Look(at_));
  const CoverageState after = Go({.x = 1.1}, 30);
  EXPECT_EQ(after.fault, CoverageFault::kNone);
  EXPECT_GT(after.moved.x(), before.moved.x() + 0.1);
}

// The camera is lost, turned and carried back, with nothing to track on the way.
TEST_F(CoverageGuideTest, WhatWasSeenBeforeSaysWhereTheCameraIs) {
  describes_ = true;
  Go({.x = 0.9, .yaw = 20.0 * kRadiansPerDegree}, 60);
  Go({.x = 0.9, .yaw = 45.0 * kRadiansPerDegree}, 30);
  const CoverageGuide::Cells before = guide_.cells();
  CoverageFrame lost = Look(at_);
  lost.tracks.clear();
  lost.describe = {};
  EXPECT_EQ(guide_.Add(lost).fault, CoverageFault::kBare);
  number_ += 2;
  at_ = {.x = 0.3, .yaw = 5.0 * kRadiansPerDegree};
  const CoverageState state = guide_.Add(Look(at_));
  EXPECT_NEAR(state.heading, 5.0 * kRadiansPerDegree, 3.0 * kRadiansPerDegree);
  EXPECT_NEAR(state.moved.x(), 0.1, 0.05);
  // Being carried gives no parallax.
  for (size_t column = 18; column < CoverageGuide::kColumns; ++column) {
    EXPECT_EQ(guide_.cells()[1][column], before[1][column]) << column;
  }
}

TEST_F(CoverageGuideTest, ErrorsThatAddedUpGoAwayWhereItBegan) {
  assumed_focal_ = 1.1 * kFocal;  // Turns seem smaller than they are.
  const auto error_after_a_walk = [&](bool describes) {
    describes_ = describes;
    guide_ = CoverageGuide(Eigen::Vector2d(kHalfWidth, kHalfHeight) / kFocal);
    at_ = {};
    CoverageState state;
    for (int round = 0; round < 3; ++round) {
      Go({.x = 0.8, .z = 0.5, .yaw = -40.0 * kRadiansPerDegree}, 40);
      Go({.x = 0.9, .z = -0.4, .yaw = 30.0 * kRadiansPerDegree}, 50);
      state = Go({}, 40);
    }
    return std::abs(state.heading);
  };
  const double by_following = error_after_a_walk(false);
  EXPECT_GT(by_following, 4.0 * kRadiansPerDegree);
  EXPECT_LT(error_after_a_walk(true), 0.5 * by_following);
}

}  // namespace
}  // namespace lararium::train
