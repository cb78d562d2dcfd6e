#include "player/kiosk/kiosk_state.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/test_files.h"

namespace lararium::player {
namespace {

TEST(KioskState, ComesBackAsItWasSaved) {
  const test::TemporaryFolder folder;
  const std::filesystem::path place = folder / "new/state";
  EXPECT_EQ(*LoadKioskState(place), KioskState()) << "none yet";
  const KioskState state = {
      "The thermopolium",
      73.25,
      {"la", "en", 0.4, {render::CaptionSize::kLarge, render::CaptionContrast::kHigh}, true, true},
      {"it", "off", 0.7}};
  ASSERT_TRUE(SaveKioskState(place, state).ok());
  EXPECT_EQ(*LoadKioskState(place), state);
}

TEST(KioskState, WhatIsNoStateIsAnErrorThatSaysWhere) {
  const test::TemporaryFolder folder;
  for (
      const char* text :
      {"", "{", "[]", "{\"schema\": 1}", "{\"schema\": 99}",
       R"({"schema":1,"title":"","seconds":-1,"language":"","captions":"","volume":1})",
       R"({"schema":1,"title":"","seconds":1,"language":"","captions":"","volume":7})",
       R"({"schema":1,"title":"","seconds":1,"language":"","captions":"","volume":1,"caption_size":"huge"})",
       R"({"schema":1,"title":"","seconds":1,"language":"","captions":"","volume":1,"caption_contrast":1})",
       R"({"schema":1,"title":"","seconds":1,"language":"","captions":"","volume":1,"descriptions":"on"})",
       R"({"schema":1,"title":"","seconds":1,"language":"","captions":"","volume":1,"house":1})",
       R"({"schema":1,"title":"","seconds":1,"language":"","captions":"","volume":1,"house":{}})"}) {
    std::ofstream(folder / "state.json", std::ios::trunc) << text;
    const auto state = LoadKioskState(folder.path());
    EXPECT_FALSE(state.ok()) << text;
    EXPECT_THAT(state.message(), ::testing::HasSubstr("state.json")) << text;
  }
}

TEST(KioskState, AFullOrForbiddenFolderIsAnError) {
  EXPECT_FALSE(SaveKioskState("/proc/nowhere", {}).ok());
}

}  // namespace
}  // namespace lararium::player
