#include "player/kiosk/kiosk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/show/small_show.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

class KioskTest : public ::testing::Test {
 protected:
  // Passes frames of a number of seconds to the kiosk. moving: the visitor looks around; otherwise
  // the headset lies on its stand.
  void Play(Kiosk& kiosk, double seconds, bool moving) {
    for (const double end = now_ + seconds; now_ < end; now_ += 1.0 / 30.0) {
      staged_.time += 1.0 / 30.0;
      staged_.camera.opacity = 1.0f;
      staged_.camera.guide = {};
      staged_.tracked.camera_from_map = geometry::Rigid3();
      geometry::Rigid3 pose;
      pose.rotation = geometry::RotationFromVector({0.0, moving ? 0.3 * std::sin(now_) : 0.0, 0.0});
      staged_.camera.camera_from_stage = pose;
      kiosk.BeforeFrame(staged_);
      kiosk.AfterFrame(now_, staged_, *show_);
    }
  }

  test::TemporaryFolder folder_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<show::Show> show_ = show::Show::Create(test::SmallContent(), {}, *log_).value();
  show::StagedFrame staged_;
  double now_ = 100.0;
};

TEST_F(KioskTest, GoesOnWhereItWasAndAfterFailedStartsAtTheBeginning) {
  {
    Kiosk kiosk(folder_.path(), {}, *log_);
    Play(kiosk, 20.0, true);
  }
  const std::string title = show_->content().title;
  Kiosk again(folder_.path(), {.number = 1, .failed_starts = 1}, *log_);
  EXPECT_NEAR(again.ResumeAt(title), 20.0, 1.5);
  EXPECT_EQ(again.ResumeAt("Another show"), 0.0);
  Kiosk failing(folder_.path(), {.number = 3, .failed_starts = 3}, *log_);
  EXPECT_EQ(failing.ResumeAt(title), 0.0) << "what is there may be what fails";
}

TEST_F(KioskTest, TheNextVisitorIsToldOnce) {
  Kiosk kiosk(folder_.path(), {}, *log_);
  Play(kiosk, 20.0, true);
  EXPECT_FALSE(kiosk.TakeNewVisitor()) << "who is there at the beginning is nobody new";
  Play(kiosk, 60.0, false);
  EXPECT_FALSE(kiosk.visited());
  Play(kiosk, 1.0, true);
  EXPECT_TRUE(kiosk.visited());
  EXPECT_TRUE(kiosk.TakeNewVisitor());
  EXPECT_FALSE(kiosk.TakeNewVisitor());
}

TEST_F(KioskTest, AtTheEndOfAVisitNobodyIsLeftAndItIsSaid) {
  Kiosk kiosk(folder_.path(), {}, *log_);
  kiosk.SetVisit({.longest = 60.0});
  Play(kiosk, 55.0, true);
  EXPECT_EQ(staged_.camera.opacity, 1.0f);
  EXPECT_EQ(staged_.camera.guide.opacity, 0.0f);
  Play(kiosk, 10.0, true);
  EXPECT_EQ(staged_.camera.opacity, 0.0f);
  EXPECT_EQ(staged_.camera.guide.opacity, 1.0f);
  EXPECT_EQ(staged_.camera.guide.says, show::StagedGuide::Says::kFarewell);
  EXPECT_EQ(kiosk.shown(), 0.0f);
  Play(kiosk, 20.0, true);
  EXPECT_TRUE(kiosk.TakeNewVisitor()) << "it was handed on";
  EXPECT_EQ(staged_.camera.opacity, 1.0f);
  EXPECT_EQ(kiosk.shown(), 1.0f);
}

TEST_F(KioskTest, AfterTheEndOfAVisitTheButtonBeginsTheNext) {
  Kiosk kiosk(folder_.path(), {}, *log_);
  kiosk.SetVisit({.longest = 60.0});
  Play(kiosk, 20.0, true);
  kiosk.BeginAgain(now_, *show_);
  EXPECT_FALSE(kiosk.TakeNewVisitor()) << "in the middle of a visit it is the same visitor";
  Play(kiosk, 45.0, true);
  EXPECT_EQ(staged_.camera.opacity, 0.0f) << "and the same time";
  kiosk.BeginAgain(now_, *show_);
  EXPECT_TRUE(kiosk.TakeNewVisitor());
  Play(kiosk, 1.0, true);
  EXPECT_EQ(staged_.camera.opacity, 1.0f);
}

TEST_F(KioskTest, KeepsWhatWasChosenAndHowTheHouseIs) {
  {
    Kiosk kiosk(folder_.path(), {}, *log_);
    kiosk.Keep({"la", "en", 0.5}, {"la", "it", 0.8}, now_);
  }
  const Result<KioskState> state = LoadKioskState(folder_.path());
  ASSERT_TRUE(state.ok()) << state.message();
  EXPECT_EQ(state->choices, (Choices{"la", "en", 0.5}));
  EXPECT_EQ(state->house, (Choices{"la", "it", 0.8}));
}

}  // namespace
}  // namespace lararium::player
