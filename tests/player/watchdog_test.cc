#include "player/kiosk/watchdog.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

using Clock = std::chrono::steady_clock;

WatchdogOptions Quick() {
  WatchdogOptions options;
  options.start_seconds = 1.0;
  options.silent_seconds = 0.6;
  options.grace_seconds = 0.2;
  options.longest_pause_seconds = 0.1;
  return options;
}

class WatchdogTest : public ::testing::Test {
 protected:
  // Runs Supervise in a process of its own. The output of the children is in said().
  int Run(const std::function<int(const ChildStart&, Heartbeat&)>& child,
          double end_after_seconds = 0.0,
          const WatchdogOptions& options = Quick()) {
    const pid_t process = ::fork();
    if (process == 0) {
      std::_Exit(Supervise(child, options, *MakeSilentLog()));
    }
    if (end_after_seconds > 0.0) {
      std::this_thread::sleep_for(std::chrono::duration<double>(end_after_seconds));
      ::kill(process, SIGTERM);
    }
    int status = 0;
    ::waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void Say(const std::string& word) const {
    std::ofstream(file_, std::ios::app) << word << '\n' << std::flush;
  }
  std::string said() const { return *ReadText(file_); }

  static void BeatFor(Heartbeat& heartbeat, double seconds) {
    const Clock::time_point begin = Clock::now();
    while (Clock::now() - begin < std::chrono::duration<double>(seconds)) {
      heartbeat.Beat();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "said";
};

TEST_F(WatchdogTest, AShowThatEndsWellIsNotBegunAgain) {
  const int code = Run([this](const ChildStart& start, Heartbeat& heartbeat) {
    Say("child " + std::to_string(start.number));
    BeatFor(heartbeat, 0.3);
    return 0;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(said(), "child 0\n");
}

TEST_F(WatchdogTest, WrongUsageIsNotTriedAgain) {
  EXPECT_EQ(Run([](const ChildStart&, Heartbeat&) { return 2; }), 2);
}

TEST_F(WatchdogTest, AShowThatAsksForItIsStartedAgainAndHasNotFailed) {
  EXPECT_EQ(Run([&](const ChildStart& start, Heartbeat&) {
              Say(std::to_string(start.failed_starts));
              return start.number == 0 ? 1 : start.number < 3 ? kStartAgain : 0;
            }),
            0);
  EXPECT_EQ(said(), "0\n1\n0\n0\n");
}

TEST_F(WatchdogTest, AShowThatCrashesIsBegunAgain) {
  const int code = Run([this](const ChildStart& start, Heartbeat& heartbeat) {
    Say(std::to_string(start.number) + "/" + std::to_string(start.failed_starts));
    BeatFor(heartbeat, 0.1);
    if (start.number < 3) {
      ::raise(start.number == 1 ? SIGKILL : SIGSEGV);
    }
    return 0;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(said(), "0/0\n1/1\n2/2\n3/3\n");
}

TEST_F(WatchdogTest, AShowThatHangsIsReplacedWithinItsTime) {
  const auto begin = Clock::now();
  const int code = Run([this](const ChildStart& start, Heartbeat& heartbeat) {
    Say("child");
    BeatFor(heartbeat, 0.2);
    if (start.number == 0) {
      std::signal(SIGTERM, SIG_IGN);
      std::this_thread::sleep_for(std::chrono::seconds(30));
    }
    return 0;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(said(), "child\nchild\n");
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(6));
}

TEST_F(WatchdogTest, AShowThatIsSlowGetsMoreTimeAfterItFailed) {
  WatchdogOptions options = Quick();
  options.start_seconds = 4.0;
  options.stable_seconds = 0.9;
  const auto child = [this](const ChildStart& start, Heartbeat& heartbeat) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));  // The time of a preparation.
    heartbeat.Beat();
    std::this_thread::sleep_for(std::chrono::milliseconds(900));  // More than silent_seconds.
    heartbeat.Beat();
    Say(std::to_string(start.failed_starts));
    return 0;
  };
  EXPECT_EQ(Run(child, 0.0, options), 0);
  EXPECT_EQ(said(), "1\n");
}

TEST_F(WatchdogTest, WhoSaysThatWorkIsLongHasTheTimeOfAStart) {
  const int code = Run([this](const ChildStart& start, Heartbeat& heartbeat) {
    Say("child");
    BeatFor(heartbeat, 0.1);
    heartbeat.BeatBeforeLongWork();
    // Sleeps longer than silent_seconds; the first time also longer than start_seconds.
    std::this_thread::sleep_for(std::chrono::milliseconds(start.number == 0 ? 2000 : 800));
    BeatFor(heartbeat, 0.1);
    return 0;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(said(), "child\nchild\n");
}

TEST_F(WatchdogTest, TheBeatAfterLongWorkEndsItsPatience) {
  const auto begin = Clock::now();
  const int code = Run([this](const ChildStart& start, Heartbeat& heartbeat) {
    Say("child");
    heartbeat.BeatBeforeLongWork();
    heartbeat.Beat();
    if (start.number == 0) {
      std::this_thread::sleep_for(std::chrono::seconds(30));
    }
    return 0;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(said(), "child\nchild\n");
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(WatchdogTest, TheEndIsPassedOnToTheShow) {
  const int code = Run(
      [this](const ChildStart&, Heartbeat& heartbeat) {
        static volatile std::sig_atomic_t asked = 0;
        std::signal(SIGTERM, [](int) { asked = 1; });
        while (asked == 0) {
          BeatFor(heartbeat, 0.05);
        }
        Say("saved");
        return 0;
      },
      0.6);
  EXPECT_EQ(code, 0);
  EXPECT_EQ(said(), "saved\n");
}

}  // namespace
}  // namespace lararium::player
