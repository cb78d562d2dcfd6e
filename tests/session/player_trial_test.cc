#include "editor/session/player_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Stopped : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

TEST(RunProgram, WhatEndsWellIsNoError) {
  NoProgress progress;
  EXPECT_TRUE(RunProgram("/bin/sh", {"-c", "echo played"}, progress).ok());
}

TEST(RunProgram, WhatEndsBadlySaysTheLastThatItSaid) {
  NoProgress progress;
  const Status status =
      RunProgram("/bin/sh", {"-c", "echo first; echo no camera >&2; exit 3"}, progress);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.message(), HasSubstr("no camera"));
  EXPECT_THAT(status.message(), testing::Not(HasSubstr("first")));
}

TEST(RunProgram, MuchOutputIsRead) {
  NoProgress progress;
  EXPECT_TRUE(RunProgram("/bin/sh", {"-c", "head -c 1000000 /dev/zero"}, progress).ok());
}

TEST(RunProgram, CancelledItIsAskedToEnd) {
  Stopped progress;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(RunProgram("/bin/sleep", {"60"}, progress).ok());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(RunProgram, WhatIsNotThereSaysSo) {
  NoProgress progress;
  EXPECT_THAT(RunProgram("/nowhere/player", {}, progress).message(),
              HasSubstr("cannot be started"));
}

TEST(TrialArguments, TheRecordingOfTheCameraViewStandsInForTheCamera) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder / "show.lararium"};
  std::filesystem::create_directories(paths.folder);
  PlaceDocument place;
  place.name = "yard";
  place.training = {SourceDocument::Kind::kVideo, "training.mp4"};
  EXPECT_THAT(TrialArguments(paths, place, "a.larshow"),
              ElementsAre("a.larshow", "--place", "yard"))
      << "a recording that is not there";
  std::ofstream(paths.folder / "training.mp4") << "x";
  EXPECT_THAT(TrialArguments(paths, place, "a.larshow"),
              ElementsAre("a.larshow", "--place", "yard", "--video",
                          (paths.folder / "training.mp4").string(), "--loop"));
  std::filesystem::create_directories(paths.folder / "walk");
  place.preview = {SourceDocument::Kind::kImages, "walk"};
  EXPECT_THAT(TrialArguments(paths, place, "a.larshow"),
              ElementsAre("a.larshow", "--place", "yard", "--images",
                          (paths.folder / "walk").string(), "--loop"));
}

}  // namespace
}  // namespace lararium::editor
