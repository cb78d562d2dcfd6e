#include "player/app/options.h"

#include <gtest/gtest.h>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

class OptionsTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(WriteFileAtomically(show_, "x").ok()); }

  Command Parse(std::vector<std::string> words) {
    std::vector<const char*> argv = {"lararium-player"};
    for (const std::string& word : words) {
      argv.push_back(word.c_str());
    }
    return ParseCommandLine(static_cast<int>(argv.size()), argv.data());
  }
  int ExitCode(const std::vector<std::string>& words) {
    const Command command = Parse(words);
    const int* code = std::get_if<int>(&command);
    return code == nullptr ? -1 : *code;
  }

  test::TemporaryFolder folder_;
  std::string show_ = (folder_ / "a.larshow").string();
};

TEST_F(OptionsTest, OnlyAKiosksVisitsHaveTheirTime) {
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--kiosk"})).kiosk.visit_minutes, 0.0);
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--kiosk", "--visit-minutes", "7.5"}))
                .kiosk.visit_minutes,
            7.5);
  EXPECT_EQ(ExitCode({show_, "--visit-minutes", "10"}), 2);
  EXPECT_EQ(ExitCode({show_, "--kiosk", "--visit-minutes", "0"}), 2);
}

TEST_F(OptionsTest, OnlyAKioskThatTrustsAKeyIsUpdated) {
  const std::string url = "https://shows.museum.example/tavern";
  const Command command = Parse({show_, "--kiosk", "--trust", show_, "--updates", url});
  EXPECT_EQ(std::get<PlayOptions>(command).updates.url, url);
  EXPECT_EQ(ExitCode({show_, "--kiosk", "--updates", url}), 2);
  EXPECT_EQ(ExitCode({show_, "--trust", show_, "--updates", url}), 2);
  EXPECT_EQ(ExitCode({show_, "--kiosk", "--trust", show_, "--updates", "file:///shows"}), 2);
}

TEST_F(OptionsTest, TheDisplayIsTheDevicesUnlessItIsGiven) {
  EXPECT_FALSE(std::get<PlayOptions>(Parse({show_})).display.mode.has_value());
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--display", "side-by-side"})).display.mode,
            Display::kSideBySide);
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--display", "mono"})).display.mode,
            Display::kMono);
  EXPECT_EQ(ExitCode({show_, "--display", "cinema"}), 2);
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--display", "openxr"})).display.mode,
            Display::kOpenXr);
  EXPECT_EQ(ExitCode({show_, "--display", "openxr", "--headless"}), 2);
}

TEST_F(OptionsTest, GraphicsAreWhatCanBeHadUnlessTheyAreGiven) {
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_})).display.graphics, std::nullopt);
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--graphics", "auto"})).display.graphics,
            std::nullopt);
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--graphics", "gl"})).display.graphics,
            render::GraphicsApi::kOpenGl33);
  EXPECT_EQ(std::get<PlayOptions>(Parse({show_, "--graphics", "gles"})).display.graphics,
            render::GraphicsApi::kOpenGlEs30);
  EXPECT_EQ(std::get<DoctorOptions>(Parse({"doctor", "--graphics", "gles"})).graphics,
            render::GraphicsApi::kOpenGlEs30);
  EXPECT_EQ(ExitCode({show_, "--graphics", "vulkan"}), 2);
  EXPECT_EQ(ExitCode({show_, "--graphics", "gles", "--display", "openxr"}), 2);
  EXPECT_EQ(ExitCode({"doctor", "--graphics", "gles", "--display", "openxr"}), 2);
}

TEST_F(OptionsTest, AStaffPageHasAPortAndMayHaveAPin) {
  const Command command = Parse({show_, "--staff-page", "0.0.0.0:8090", "--staff-pin-file", show_});
  const auto* play = std::get_if<PlayOptions>(&command);
  ASSERT_NE(play, nullptr);
  EXPECT_EQ(play->staff_page.address, "0.0.0.0:8090");
  EXPECT_EQ(play->staff_page.pin, show_);
  EXPECT_EQ(ExitCode({show_, "--staff-page", "page"}), 2);
  EXPECT_EQ(ExitCode({show_, "--staff-page", "70000"}), 2);
  EXPECT_EQ(ExitCode({show_, "--staff-pin-file", show_}), 2) << "without a page";
  EXPECT_EQ(ExitCode({"doctor", "--staff-page", "nowhere0:80"}), 2);
  EXPECT_EQ(ExitCode({"doctor", "--size", "641x480"}), 2);
}

TEST_F(OptionsTest, ADeviceJoinsAFleetWithItsPassword) {
  const std::string password = (folder_ / "password").string();
  ASSERT_TRUE(WriteFileAtomically(password, "nox-atra").ok());
  std::filesystem::permissions(password, std::filesystem::perms::owner_read);
  const std::string address = "mqtts://192.168.1.5/pompeii";
  const Command command = Parse({show_, "--fleet", address, "--fleet-name", "tablet-01", "--group",
                                 "red", "--guide", "--fleet-password-file", password});
  const auto* play = std::get_if<PlayOptions>(&command);
  ASSERT_NE(play, nullptr);
  EXPECT_EQ(play->fleet.address, address);
  EXPECT_EQ(play->fleet.name, "tablet-01");
  EXPECT_EQ(play->fleet.group, "red");
  EXPECT_TRUE(play->fleet.guide);
  EXPECT_EQ(ExitCode({show_, "--fleet", address}), 2) << "without a password or certificate";
  EXPECT_EQ(ExitCode({show_, "--fleet", "mqtt://h/s", "--fleet-password-file", password}), 2);
  EXPECT_EQ(ExitCode({show_, "--group", "red"}), 2) << "without a fleet";
}

TEST_F(OptionsTest, AFleetIsSetUpWithoutAShow) {
  const Command command = Parse({"fleet-setup", "fleet", "--host", "192.168.1.5", "--site",
                                 "pompeii", "--add", "tablet-01:red", "tablet-02"});
  const auto* setup = std::get_if<FleetSetupOptions>(&command);
  ASSERT_NE(setup, nullptr);
  EXPECT_EQ(setup->folder, "fleet");
  EXPECT_EQ(setup->devices, (std::vector<std::string>{"tablet-01:red", "tablet-02"}));
  EXPECT_FALSE(setup->certificates.has_value());
  EXPECT_EQ(std::get<FleetSetupOptions>(
                Parse({"fleet-setup", "fleet", "--devices-prove-by", "certificates"}))
                .certificates,
            true);
  const auto page = std::get<PageServerOptions>(Parse({"fleet-page", folder_.path().string()}));
  EXPECT_EQ(page.address, "0.0.0.0:8443");
  EXPECT_EQ(ExitCode({"fleet-page", folder_.path().string(), "--address", "page"}), 2);
  EXPECT_EQ(ExitCode({"fleet-setup"}), 2);
  EXPECT_EQ(ExitCode({"fleet-setup", "fleet", "--port", "70000"}), 2);
}

TEST_F(OptionsTest, HowCaptionsLookIsLeftToTheVisitorUnlessItIsGiven) {
  EXPECT_FALSE(std::get<PlayOptions>(Parse({show_})).choices.caption_size.has_value());
  const auto play = std::get<PlayOptions>(
      Parse({show_, "--caption-size", "largest", "--caption-contrast", "high"}));
  EXPECT_EQ(play.choices.caption_size, render::CaptionSize::kLargest);
  EXPECT_EQ(play.choices.caption_contrast, render::CaptionContrast::kHigh);
  EXPECT_FALSE(play.choices.descriptions.has_value() || play.choices.reduced_motion.has_value());
  const auto other =
      std::get<PlayOptions>(Parse({show_, "--descriptions", "on", "--reduced-motion", "off"}));
  EXPECT_EQ(other.choices.descriptions, true);
  EXPECT_EQ(other.choices.reduced_motion, false);
  EXPECT_EQ(ExitCode({show_, "--descriptions", "maybe"}), 2);
  EXPECT_EQ(ExitCode({show_, "--caption-size", "huge"}), 2);
  EXPECT_EQ(ExitCode({show_, "--caption-contrast", "low"}), 2);
}

TEST_F(OptionsTest, ReadsWhatTheDesignNames) {
  const Command command = Parse({show_, "--headless", "--pace", "fast", "--frames", "9",
                                 "--intrinsics", "500,500,320,240", "--record", "out.mp4"});
  const auto* play = std::get_if<PlayOptions>(&command);
  ASSERT_NE(play, nullptr);
  EXPECT_TRUE(play->display.headless);
  EXPECT_EQ(play->pace, Pace::kFast);
  EXPECT_EQ(play->frames, 9);
  EXPECT_EQ(play->camera.intrinsics, (std::vector<double>{500, 500, 320, 240}));
}

TEST_F(OptionsTest, ABenchmarkTakesItsImagesFromItsOwnFolder) {
  const std::string folder = folder_.path().string();
  const Command command = Parse({show_, "--benchmark", folder, "--foreign", folder, "--foreign",
                                 show_, "--first-pose", "--unknown-lens", "--smoothing", "strong"});
  const auto* play = std::get_if<PlayOptions>(&command);
  ASSERT_NE(play, nullptr);
  EXPECT_EQ(play->benchmark.folder, folder);
  EXPECT_EQ(play->benchmark.foreign.size(), 2u);
  EXPECT_TRUE(play->benchmark.first_pose);
  EXPECT_TRUE(play->benchmark.unknown_lens);
  EXPECT_EQ(play->smoothing, vision::Smoothing::kStrong);
  EXPECT_EQ(ExitCode({show_, "--benchmark", folder, "--camera", "0"}), 2);
  EXPECT_EQ(ExitCode({show_, "--foreign", folder}), 2);
  EXPECT_EQ(ExitCode({show_, "--first-pose"}), 2);
  EXPECT_EQ(ExitCode({show_, "--unknown-lens"}), 2);
  EXPECT_EQ(ExitCode({show_, "--smoothing", "much"}), 2);
}

TEST_F(OptionsTest, AKioskIsFullScreenOnTheFirstMonitorUnlessToldOtherwise) {
  const auto monitor = [this](std::vector<std::string> more) {
    more.insert(more.begin(), show_);
    return std::get<PlayOptions>(Parse(more)).display.monitor;
  };
  EXPECT_LT(monitor({}), 0) << "a window";
  EXPECT_EQ(monitor({"--kiosk"}), 0);
  EXPECT_EQ(monitor({"--kiosk", "--monitor", "1"}), 1);
  EXPECT_LT(monitor({"--kiosk", "--headless"}), 0);
  EXPECT_LT(monitor({"--kiosk", "--display", "openxr"}), 0) << "the headset shows it";
}

TEST_F(OptionsTest, SoundGoesWhereItIsTold) {
  const Command plain = Parse({show_});
  EXPECT_FALSE(std::get<PlayOptions>(plain).listening.has_value());
  const Command command = Parse({show_, "--audio", "speakers", "--sound", "mix.wav"});
  const auto* play = std::get_if<PlayOptions>(&command);
  ASSERT_NE(play, nullptr);
  EXPECT_EQ(play->listening, Listening::kSpeakers);
  EXPECT_EQ(play->output.sound, "mix.wav");
  EXPECT_EQ(ExitCode({show_, "--audio", "loud"}), 2);
}

TEST_F(OptionsTest, InfoTakesABundle) {
  const Command command = Parse({"info", show_});
  ASSERT_NE(std::get_if<InfoOptions>(&command), nullptr);
}

TEST_F(OptionsTest, WrongUsageIsExitCodeTwo) {
  EXPECT_EQ(ExitCode({}), 2);
  EXPECT_EQ(ExitCode({(folder_ / "none.larshow").string()}), 2);
  EXPECT_EQ(ExitCode({show_, "--camera", "0", "--video", show_}), 2);
  EXPECT_EQ(ExitCode({show_, "--intrinsics", "1,2,3"}), 2);
  EXPECT_EQ(ExitCode({show_, "--intrinsics", "1,2,3,4,5"}), 2);
  EXPECT_EQ(ExitCode({show_, "--pace", "slow"}), 2);
  EXPECT_EQ(ExitCode({show_, "--frames", "-1"}), 2);
  EXPECT_EQ(ExitCode({show_, "--headless", "--monitor", "0"}), 2);
  EXPECT_EQ(ExitCode({"info"}), 2);
}

TEST_F(OptionsTest, HelpIsSuccess) { EXPECT_EQ(ExitCode({"--help"}), 0); }

}  // namespace
}  // namespace lararium::player
