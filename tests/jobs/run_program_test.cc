#include "editor/jobs/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

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
  EXPECT_TRUE(
      RunProgram("/bin/sh", {"-c", "echo played"}, {"install it", "look at it"}, progress).ok());
}

TEST(RunProgram, WhatEndsBadlySaysTheLastThatItSaid) {
  NoProgress progress;
  const Status status = RunProgram("/bin/sh", {"-c", "echo first; echo no camera >&2; exit 3"},
                                   {"install it", "look at it"}, progress);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.message(), HasSubstr("no camera"));
  EXPECT_THAT(status.message(), testing::Not(HasSubstr("first")));
}

TEST(RunProgram, MuchOutputIsRead) {
  NoProgress progress;
  EXPECT_TRUE(RunProgram("/bin/sh", {"-c", "head -c 1000000 /dev/zero"},
                         {"install it", "look at it"}, progress)
                  .ok());
}

TEST(RunProgram, CancelledItIsAskedToEnd) {
  Stopped progress;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(RunProgram("/bin/sleep", {"60"}, {"install it", "look at it"}, progress).ok());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(RunProgram, WhatIsNotThereSaysSo) {
  NoProgress progress;
  EXPECT_THAT(RunProgram("/nowhere/player", {}, {"install it", "look at it"}, progress).message(),
              HasSubstr("cannot be started"));
}

TEST(RunProgram, EachLineIsPassedOn) {
  NoProgress progress;
  std::vector<std::string> lines;
  EXPECT_TRUE(RunProgram("/bin/sh", {"-c", "echo one; echo two >&2"}, {}, progress,
                         [&](const std::string& line) { lines.push_back(line); })
                  .ok());
  EXPECT_THAT(lines, ElementsAre("one", "two"));
}

}  // namespace
}  // namespace lararium::editor
