#include "editor/window/window_sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

WindowSizes Dragged() {
  WindowSizes sizes;
  sizes.width = 1703;
  sizes.height = 1011;
  sizes.maximized = true;
  sizes.panels = {301.5, 412.25, {250.0, 500.0, 161.0, 99.5}};
  return sizes;
}

TEST(WindowSizes, ComeBackAsTheyWereLeft) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "state/window.json";
  const Result<WindowSizes> first = LoadWindowSizes(file);
  ASSERT_TRUE(first.ok()) << first.message();
  EXPECT_EQ(*first, WindowSizes());
  ASSERT_TRUE(SaveWindowSizes(file, Dragged()).ok());
  const Result<WindowSizes> loaded = LoadWindowSizes(file);
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  EXPECT_EQ(*loaded, Dragged());
}

// A valid file with one part of it replaced.
class DamagedWindowSizes : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(DamagedWindowSizes, AreToldOfOnceAndMovedAside) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "window.json";
  std::string text =
      R"({"schema": 1, "window": {"width": 1440, "height": 900}, "maximized": false,
          "outliner": 224, "inspector": 336, "bottom": [336, 400, 240, 136]})";
  ASSERT_TRUE(WriteFileAtomically(file, std::string_view(text)).ok());
  ASSERT_TRUE(LoadWindowSizes(file).ok());
  const std::string good = GetParam().first;
  text.replace(text.find(good), good.size(), GetParam().second);
  ASSERT_TRUE(WriteFileAtomically(file, std::string_view(text)).ok());
  const Result<WindowSizes> loaded = LoadWindowSizes(file);
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.message(), testing::HasSubstr("window.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "window.json.damaged"));
  EXPECT_EQ(*LoadWindowSizes(file), WindowSizes());
}

INSTANTIATE_TEST_SUITE_P(Files,
                         DamagedWindowSizes,
                         testing::Values(std::pair{"\"schema\": 1", "\"schema\": 2"},
                                         std::pair{"1440", "0"},
                                         std::pair{"900", "1e9"},
                                         std::pair{"900}", "900, \"depth\": 3}"},
                                         std::pair{"false", "7"},
                                         std::pair{"224", "-1"},
                                         std::pair{"336,", "\"wide\","},
                                         std::pair{", 136]", "]"},
                                         std::pair{"136]", "136, 20]"},
                                         std::pair{"{\"schema\"", "{\"x\": 1, \"schema\""}));

}  // namespace
}  // namespace lararium::editor
