#include "player/kiosk/kiosk_state.h"

#include <gmock/gmock.h>

#include <fstream>

#include "shared/core/json.h"
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
      {"it", "off", 0.7, {}, false, false, "it"}};
  ASSERT_TRUE(SaveKioskState(place, state).ok());
  EXPECT_EQ(*LoadKioskState(place), state);
}

TEST(KioskState, WhatIsNoStateIsAnErrorThatSaysWhere) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(SaveKioskState(folder.path(), {}).ok());
  const Json saved = *LoadJson(folder / "state.json");
  std::vector<std::string> texts = {"", "{", "[]", "{\"schema\": 1}", "{\"schema\": 99}"};
  for (const auto& [name, wrong] : {std::pair<const char*, Json>{"seconds", -1},
                                    {"volume", 7},
                                    {"caption_size", "huge"},
                                    {"caption_contrast", 1},
                                    {"descriptions", "on"},
                                    {"house", 1},
                                    {"house", Json::object()}}) {
    Json json = saved;
    json[name] = wrong;
    texts.push_back(json.dump());
  }
  for (const auto& [name, value] : saved.items()) {
    if (name == "read") {
      continue;  // An older player's state lacks it (below).
    }
    Json json = saved;
    json.erase(name);
    texts.push_back(json.dump());
  }
  for (const std::string& text : texts) {
    std::ofstream(folder / "state.json", std::ios::trunc) << text;
    const auto state = LoadKioskState(folder.path());
    EXPECT_FALSE(state.ok()) << text;
    EXPECT_THAT(state.message(), ::testing::HasSubstr("state.json")) << text;
  }
}

TEST(KioskState, TheStateOfAPlayerThatKeptNoReadingLanguageLoads) {
  const test::TemporaryFolder folder;
  KioskState state;
  state.choices.captions = "it";
  state.choices.read = "en";
  ASSERT_TRUE(SaveKioskState(folder.path(), state).ok());
  Json json = *LoadJson(folder / "state.json");
  json.erase("read");
  json["house"].erase("read");
  std::ofstream(folder / "state.json", std::ios::trunc) << json.dump();
  const auto loaded = LoadKioskState(folder.path());
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  EXPECT_EQ(loaded->choices.captions, "it");
  EXPECT_EQ(loaded->choices.read, "");
}

TEST(KioskState, AFullOrForbiddenFolderIsAnError) {
  EXPECT_FALSE(SaveKioskState("/proc/nowhere", {}).ok());
}

}  // namespace
}  // namespace lararium::player
