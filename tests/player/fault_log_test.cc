#include "player/kiosk/fault_log.h"

#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "player/kiosk/kiosk.h"
#include "player/kiosk/recent_warnings.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using vision::TrackReason;

class FaultLogTest : public ::testing::Test {
 protected:
  void SetUp() override { ear_->set_level(spdlog::level::info); }

  // Passes images of a number of seconds to the log.
  void Watch(double seconds, TrackReason reason) {
    for (int i = 0; i < seconds * 30; ++i) {
      vision::TrackedFrame tracked;
      tracked.frame.capture_time = time_ += 1.0 / 30.0;
      tracked.reason = reason;
      if (reason == TrackReason::kNone) {
        tracked.camera_from_map = geometry::Rigid3();
      }
      faults_.AfterFrame(tracked);
    }
  }
  std::vector<std::string> Lines() {
    std::vector<std::string> lines;
    for (const RecentWarnings::Entry& entry : ear_->Entries()) {
      lines.push_back(entry.text + (entry.times > 1 ? " (again)" : ""));
    }
    return lines;
  }

  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::shared_ptr<RecentWarnings> ear_ = RecentWarnings::Of(*log_);
  FaultLog faults_{*log_};
  double time_ = 0.0;
};

TEST_F(FaultLogTest, ALossIsToldWithItsReasonAndItsEndHoweverLongItLasts) {
  Watch(3.0, TrackReason::kNone);
  Watch(60.0, TrackReason::kTooDark);
  Watch(3.0, TrackReason::kNone);
  EXPECT_THAT(Lines(), ElementsAre(HasSubstr("not found: too dark"), HasSubstr("after 60.0 s")));
}

TEST_F(FaultLogTest, WhoLooksAwayForAMomentIsNotTold) {
  for (int i = 0; i < 100; ++i) {
    Watch(0.9, TrackReason::kTooFewMatches);
    Watch(0.1, TrackReason::kNone);
  }
  EXPECT_THAT(Lines(), ElementsAre());
}

TEST_F(FaultLogTest, ALossOfWhichTheReasonChangesIsOne) {
  Watch(2.0, TrackReason::kTooFewMatches);
  Watch(2.0, TrackReason::kTooFewFeatures);
  Watch(2.0, TrackReason::kTooDark);
  EXPECT_THAT(Lines(), ElementsAre(HasSubstr("another place")));
}

TEST_F(FaultLogTest, TheCameraAndItsClockAreTold) {
  faults_.CameraChanged(false, "camera 0: gives no image");
  faults_.CameraChanged(true, "");
  faults_.ClockChanged(false, -500.0);
  faults_.ClockChanged(true, 0.0);
  EXPECT_THAT(Lines(), ElementsAre("camera 0: gives no image; waiting for it", "the camera is back",
                                   HasSubstr("leapt by -500.0 s"), HasSubstr("steady again")));
}

TEST_F(FaultLogTest, AKioskWhoseFolderCannotBeWrittenTellsSoOnceAndWhenItCanBeAgain) {
  const test::TemporaryFolder folder;
  const std::filesystem::path state = folder / "state";
  std::ofstream(state) << "not a folder";
  {
    Kiosk kiosk(state, {}, *log_);
    const auto keep_until = [&](const char* said) {
      for (int i = 0;
           i < 1000 && (Lines().empty() || Lines().back().find(said) == std::string::npos); ++i) {
        kiosk.Keep({}, {}, 0.0);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    };
    keep_until("begin at its beginning");
    std::filesystem::remove(state);
    keep_until("kept again");
  }
  EXPECT_THAT(Lines(), ElementsAre(HasSubstr("the show will begin at its beginning"),
                                   "where the show is can be kept again"));
  EXPECT_TRUE(std::filesystem::exists(state / "state.json"));
}

}  // namespace
}  // namespace lararium::player
