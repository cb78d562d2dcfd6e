#include "shared/show/tracking_loss_fader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shared/core/random.h"

namespace lararium::show {
namespace {

using geometry::Rigid3;
using State = TrackingLossFader::State;

constexpr double kFrame = 1.0 / 30.0;

geometry::CameraModel Display() {
  geometry::CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

// A visitor who looks around: up to about 25 pixels of motion per frame.
Rigid3 Walk(double time) {
  const Eigen::Vector3d turn(0.15 * std::sin(1.9 * time), 0.6 * std::sin(1.1 * time), 0.0);
  return {geometry::RotationFromVector(turn),
          {0.2 * std::sin(time), 0.0, 2.0 + 0.3 * std::cos(0.7 * time)}};
}

TrackingLossFader::View At(TrackingLossFader& fader,
                           double time,
                           bool tracked,
                           uint32_t place = 0) {
  return fader.Update(time, tracked ? std::optional(Walk(time)) : std::nullopt, place, Display());
}

// Tracks for two seconds, until people are fully visible.
double Settle(TrackingLossFader& fader) {
  double time = 0.0;
  for (; time < 2.0; time += kFrame) {
    At(fader, time, true);
  }
  return time;
}

TEST(TrackingLossFader, WithAPosePeopleAreWhereItSaysAfterTheyAppeared) {
  TrackingLossFader fader;
  EXPECT_EQ(At(fader, 0.0, true).opacity, 0.0f) << "they do not pop up";
  const double time = Settle(fader);
  const TrackingLossFader::View view = At(fader, time, true);
  EXPECT_EQ(view.state, State::kShown);
  EXPECT_EQ(view.opacity, 1.0f);
  EXPECT_EQ(view.guide, 0.0f);
  ASSERT_TRUE(view.camera_from_stage);
  EXPECT_NEAR(PictureShiftOf(Display(), Walk(time), *view.camera_from_stage), 0.0, 1e-6);
}

TEST(TrackingLossFader, ClimbsDownInItsOrder) {
  TrackingLossFader fader;
  const double lost = Settle(fader);
  std::vector<State> rungs;
  float opacity = 1.0f;
  for (double time = lost; time < lost + 4.0; time += kFrame) {
    const TrackingLossFader::View view = At(fader, time, false);
    if (rungs.empty() || rungs.back() != view.state) {
      rungs.push_back(view.state);
    }
    EXPECT_LE(view.opacity, opacity);
    opacity = view.opacity;
    const double since = time - lost;
    EXPECT_EQ(view.opacity == 1.0f, since < 0.25 - 1e-9) << since;
    EXPECT_EQ(view.guide > 0.0f, since >= 2.0) << since;
    EXPECT_EQ(view.camera_from_stage.has_value(), view.opacity > 0.0f);
    EXPECT_NEAR(view.lost_seconds, since, 1e-9);
  }
  EXPECT_EQ(rungs, (std::vector<State>{State::kHeld, State::kFading, State::kGone}));
}

TEST(TrackingLossFader, NobodyStandsInABlackPicture) {
  TrackingLossFader fader;
  const double time = Settle(fader);
  const TrackingLossFader::View covered = fader.Update(time, std::nullopt, 0, Display(), true);
  EXPECT_EQ(covered.state, State::kGone);
  EXPECT_EQ(covered.opacity, 0.0f);
  EXPECT_FALSE(covered.camera_from_stage);
  // People return as after any loss.
  const TrackingLossFader::View back = At(fader, time + kFrame, true);
  EXPECT_EQ(back.state, State::kShown);
  EXPECT_LT(back.opacity, 0.2f);
}

TEST(TrackingLossFader, WhoNeverFoundThePlaceIsGuidedToo) {
  TrackingLossFader fader;
  for (double time = 0.0; time < 2.5; time += kFrame) {
    EXPECT_EQ(At(fader, time, false).state, State::kSearching);
  }
  EXPECT_GT(At(fader, 2.5, false).guide, 0.9f);
}

TEST(TrackingLossFader, OneLostFrameIsNotSeenHoweverFastTheCameraTurns) {
  TrackingLossFader fader;
  double time = Settle(fader);
  for (int lost = 0; lost < 60; ++lost) {
    for (int i = 0; i < 12; ++i, time += kFrame) {
      const TrackingLossFader::View view = At(fader, time, i != 5);
      EXPECT_EQ(view.opacity, 1.0f) << time;
      ASSERT_TRUE(view.camera_from_stage);
      EXPECT_LT(PictureShiftOf(Display(), Walk(time), *view.camera_from_stage), 4.0) << time;
    }
  }
}

TEST(TrackingLossFader, NothingThatIsSeenJumpsWhateverIsLost) {
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    TrackingLossFader fader;
    std::optional<Rigid3> before;
    float opacity = 0.0f;
    bool tracked = true;
    double step = kFrame;
    for (double time = 0.0; time < 30.0; time += step) {
      if (random.Uniform() < (tracked ? 0.03 : 0.1)) {
        tracked = !tracked;
      }
      const TrackingLossFader::View view = At(fader, time, tracked);
      EXPECT_LE(std::abs(view.opacity - opacity), step / 0.12 + 1e-5) << seed << " " << time;
      if (before && view.camera_from_stage && std::min(opacity, view.opacity) > 0.12f) {
        const double moved = PictureShiftOf(Display(), *before, *view.camera_from_stage);
        const double camera = PictureShiftOf(Display(), Walk(time - step), Walk(time));
        EXPECT_LT(moved, camera + 8.0) << seed << " " << time << " opacity " << view.opacity;
      }
      before = view.camera_from_stage;
      opacity = view.opacity;
      step = kFrame * (0.6 + 0.8 * random.Uniform());
    }
  }
}

TEST(TrackingLossFader, WithoutGlidingPeopleGoAndComeAgainWhereTheyAre) {
  const geometry::Rigid3 shift = {Eigen::Quaterniond::Identity(), {0.02, 0.0, 0.0}};
  const geometry::Rigid3 still = Walk(0.0);
  for (const bool glides : {true, false}) {
    TrackingLossFader fader;
    fader.SetGlides(glides);
    double time = 0.0;
    for (; time < 2.0; time += kFrame) {
      fader.Update(time, still, 0, Display());
    }
    fader.Update(time, std::nullopt, 0, Display());
    // Tracking returns a few pixels away: no visible pose lies in between.
    double between = 0.0;
    float least = 1.0f;
    for (double end = time + 1.0; time < end;) {
      time += kFrame;
      const TrackingLossFader::View view = fader.Update(time, shift * still, 0, Display());
      least = std::min(least, view.opacity);
      if (view.camera_from_stage) {
        between = std::max(
            between, std::min(PictureShiftOf(Display(), still, *view.camera_from_stage),
                              PictureShiftOf(Display(), shift * still, *view.camera_from_stage)));
      }
    }
    EXPECT_EQ(between > 0.5, glides);
    EXPECT_EQ(least < 0.1f, !glides);
    EXPECT_EQ(fader.Update(time + kFrame, shift * still, 0, Display()).opacity, 1.0f);
  }
}

TEST(TrackingLossFader, FoundAtAnotherPlacePeopleGoBeforeTheyComeThere) {
  TrackingLossFader fader;
  double time = Settle(fader);
  At(fader, time += kFrame, false);
  float opacity = 1.0f;
  for (int i = 0; i < 60; ++i) {
    const TrackingLossFader::View view = At(fader, time += kFrame, true, 1);
    if (view.place == 0) {
      EXPECT_LT(view.opacity, opacity);
    }
    if (view.place == 1 && opacity > 0.0f && i < 6) {
      EXPECT_LT(view.opacity, 0.3f);
    }
    opacity = view.opacity;
  }
  EXPECT_EQ(opacity, 1.0f);
  EXPECT_EQ(At(fader, time + kFrame, true, 1).place, 1u);
}

TEST(TrackingLossFader, ALeapInTimeShowsTheFrameAsItIs) {
  TrackingLossFader fader;
  Settle(fader);
  EXPECT_EQ(At(fader, 100.0, true).opacity, 1.0f) << "ahead";
  EXPECT_EQ(At(fader, 5.0, true).opacity, 1.0f) << "back";
  EXPECT_EQ(At(fader, 90.0, false).opacity, 0.0f);
  EXPECT_EQ(At(fader, 90.0, false).guide, 0.0f);
}

TEST(TrackingLossFader, TheNextVisitorBeginsAnew) {
  TrackingLossFader fader;
  const double time = Settle(fader);
  fader.Reset();
  EXPECT_FALSE(fader.last_pose());
  EXPECT_EQ(At(fader, time + kFrame, true).opacity, 0.0f);
}

TEST(TrackingLossFaderOptions, ThatMakeNoSenseAreRefused) {
  TrackingLossFaderOptions options;
  EXPECT_TRUE(options.Validate().ok());
  options.fade = -1.0;
  EXPECT_FALSE(options.Validate().ok());
  options = {};
  options.hold = std::nan("");
  EXPECT_FALSE(options.Validate().ok());
}

}  // namespace
}  // namespace lararium::show
