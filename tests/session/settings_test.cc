#include "editor/session/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

TEST(Settings, ComeBackAsTheyWereChosen) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "config/editor.json";
  const Result<Settings> first = LoadSettings(file);
  ASSERT_TRUE(first.ok()) << first.message();
  EXPECT_EQ(*first, Settings());
  for (const double scale : kScales) {
    const Settings chosen{Theme::kLight, scale, ""};
    ASSERT_TRUE(SaveSettings(file, chosen).ok());
    const Result<Settings> loaded = LoadSettings(file);
    ASSERT_TRUE(loaded.ok()) << loaded.message();
    EXPECT_EQ(*loaded, chosen);
  }
}

TEST(Settings, KeepTheLanguageThatWasChosen) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "editor.json";
  for (const char* language : kLanguages) {
    Settings chosen;
    chosen.language = language;
    ASSERT_TRUE(SaveSettings(file, chosen).ok());
    const Result<Settings> loaded = LoadSettings(file);
    ASSERT_TRUE(loaded.ok()) << loaded.message();
    EXPECT_EQ(*loaded, chosen);
  }
}

class DamagedSettings : public testing::TestWithParam<const char*> {};

TEST_P(DamagedSettings, AreToldOfOnceAndMovedAside) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "editor.json";
  ASSERT_TRUE(WriteFileAtomically(file, std::string_view(GetParam())).ok());
  const Result<Settings> loaded = LoadSettings(file);
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.message(), testing::HasSubstr("editor.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "editor.json.damaged"));
  EXPECT_TRUE(LoadSettings(file).ok());
}

INSTANTIATE_TEST_SUITE_P(
    Files,
    DamagedSettings,
    testing::Values(
        "",
        "7",
        R"({"schema": 2, "theme": "dark", "scale": 1, "language": ""})",
        R"({"schema": 1, "theme": "pink", "scale": 1, "language": ""})",
        R"({"schema": 1, "theme": "dark", "scale": 40, "language": ""})",
        R"({"schema": 1, "theme": "dark", "scale": "1", "language": ""})",
        R"({"schema": 1, "theme": "dark", "scale": 1, "language": "xx"})",
        R"({"schema": 1, "theme": "dark", "scale": 1, "language": 7})",
        R"({"schema": 1, "theme": "dark", "language": ""})",
        R"({"schema": 1, "theme": "dark", "scale": 1})",
        R"({"schema": 1, "theme": "dark", "scale": 1, "language": "", "sound": true})"));

}  // namespace
}  // namespace lararium::editor
