#include "editor/session/sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "editor/document/project.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProject = "thermopolium/thermopolium.lararium";
constexpr const char* kScene = "thermopolium/thermopolium.lararium/places/maquette/scene.larscene";
constexpr const char* kFilm = "maquette/maquette.lararium/places/maquette/training.mp4";

void Write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  ASSERT_TRUE(WriteFileAtomically(file, std::string_view(text)).ok());
}

void WriteSample(const fs::path& sample, const std::string& drama = "-- shipped") {
  if (!fs::exists(sample / kProject)) {
    ASSERT_TRUE(CreateProject({sample / kProject}, "Sample").ok());
  }
  Write(sample / kProject / "drama.lua", drama);
  Write(sample / kProject / "lines.csv", "id");
  Write(sample / kFilm, "film");
}

class SampleTest : public testing::Test {
 protected:
  SampleTest() { WriteSample(shipped_); }

  // The user's copy; empty after a failure.
  fs::path Own() {
    Result<fs::path> own = OwnSample(shipped_, folder_ / "mine", progress_);
    EXPECT_TRUE(own.ok()) << own.message();
    return own.ok() ? *own : fs::path();
  }
  static std::string Text(const fs::path& file) {
    const Result<std::string> text = ReadText(file);
    return text.ok() ? *text : text.message();
  }

  const test::TemporaryFolder folder_;
  const fs::path shipped_ = folder_ / "shipped";
  NoProgress progress_;
};

TEST_F(SampleTest, IsCopiedWithTheFilmsOfItsPlaceAndThenKeptAsItWasEdited) {
  EXPECT_EQ(Own(), folder_ / "mine/sample");
  EXPECT_EQ(Text(Own() / kFilm), "film");
  Write(Own() / kProject / "drama.lua", "-- mine");
  EXPECT_EQ(Text(Own() / kProject / "drama.lua"), "-- mine");
  EXPECT_EQ(Text(shipped_ / kProject / "drama.lua"), "-- shipped");
}

TEST_F(SampleTest, ACopyOfReadOnlyFilesCanBeChanged) {
  const fs::path drama = fs::path(kProject) / "drama.lua";
  fs::permissions(shipped_ / drama, fs::perms::owner_read);
  EXPECT_NE(fs::status(Own() / drama).permissions() & fs::perms::owner_write, fs::perms::none);
}

TEST_F(SampleTest, ACopyThatWasInterruptedIsCompleted) {
  Write(folder_ / "mine/sample" / kProject / "drama.lua.part", "-- shi");
  EXPECT_EQ(Own(), folder_ / "mine/sample");
  EXPECT_EQ(Text(Own() / kProject / "drama.lua"), "-- shipped");
}

TEST_F(SampleTest, WhatWasPreparedLaterIsAddedWithoutTouchingTheUsersFiles) {
  Write(Own() / kProject / "drama.lua", "-- mine");
  Write(shipped_ / kScene, "map");
  EXPECT_TRUE(IsTrained(Own()));
  EXPECT_EQ(Text(Own() / kProject / "drama.lua"), "-- mine");
  Write(Own() / kScene, "my map");
  EXPECT_EQ(Text(Own() / kScene), "my map");
}

TEST_F(SampleTest, ANewerSampleIsCopiedBesideTheOlderCopy) {
  Write(Own() / kProject / "drama.lua", "-- mine");
  WriteSample(shipped_, "-- newer");
  EXPECT_EQ(Own(), folder_ / "mine/sample-2");
  EXPECT_EQ(Text(Own() / kProject / "drama.lua"), "-- newer");
  EXPECT_EQ(Text(folder_ / "mine/sample" / kProject / "drama.lua"), "-- mine");
}

TEST_F(SampleTest, WithoutOneTheErrorSaysWhere) {
  const auto own = OwnSample(folder_ / "nowhere", folder_ / "mine", progress_);
  ASSERT_FALSE(own.ok());
  EXPECT_THAT(own.message(), testing::HasSubstr("nowhere"));
}

TEST_F(SampleTest, WithoutRoomTheErrorSaysSo) {
  Write(folder_ / "file", "");
  const auto own = OwnSample(shipped_, folder_ / "file", progress_);
  ASSERT_FALSE(own.ok());
  EXPECT_THAT(own.message(), testing::HasSubstr("cannot be copied"));
}

TEST_F(SampleTest, IsTheInstalledOneElseThePreparedOneElseTheBareScenes) {
  const fs::path program = folder_ / "checkout/build/release/bin";
  fs::create_directories(program);
  EXPECT_EQ(ShippedSample(program), fs::path());
  WriteSample(folder_ / "checkout/scenes");
  EXPECT_EQ(ShippedSample(program), folder_ / "checkout/scenes");
  WriteSample(folder_ / "checkout/build/demo");
  EXPECT_EQ(ShippedSample(program), folder_ / "checkout/scenes") << "the place is not trained yet";
  Write(folder_ / "checkout/build/demo" / kScene, "map");
  EXPECT_EQ(ShippedSample(program), folder_ / "checkout/build/demo");
  const fs::path installed = folder_ / "checkout/build/release/share/lararium/sample";
  WriteSample(installed);
  Write(installed / kScene, "map");
  EXPECT_EQ(ShippedSample(program), installed);
}

}  // namespace
}  // namespace lararium::editor
