#include "editor/session/recent_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core.hpp>
#include <string>

#include "editor/document/project.h"
#include "editor/document/project_paths.h"
#include "editor/document/user_folders.h"
#include "editor/session/project_picture.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RecentProjectsTest : public testing::Test {
 protected:
  // The folders, newest first, as another window reads them.
  std::vector<std::string> Listed() {
    RecentProjects other(file_);
    EXPECT_TRUE(other.Reload().ok());
    std::vector<std::string> folders;
    for (const RecentProject& project : other.entries()) {
      folders.push_back(project.folder.filename().string());
    }
    return folders;
  }
  fs::path Folder(const std::string& name) { return folder_ / name; }

  test::TemporaryFolder folder_;
  fs::path file_ = folder_ / "state/recent.json";
  RecentProjects recent_{file_};
};

TEST_F(RecentProjectsTest, TheProjectOpenedLastComesFirstAndIsThereOnce) {
  EXPECT_TRUE(recent_.Reload().ok());
  EXPECT_TRUE(recent_.entries().empty());
  EXPECT_TRUE(recent_.NoteOpened({Folder("a"), "A", 10}).ok());
  EXPECT_TRUE(recent_.NoteOpened({Folder("b"), "B", 20}).ok());
  EXPECT_TRUE(recent_.NoteOpened({Folder("x/../a/"), "A anew", 30}).ok());
  EXPECT_THAT(Listed(), testing::ElementsAre("a", "b"));
  EXPECT_EQ(recent_.entries().front().title, "A anew");
  EXPECT_EQ(recent_.entries().front().opened, 30);
}

TEST_F(RecentProjectsTest, WindowsDoNotOverwriteOneAnother) {
  RecentProjects other(file_);
  EXPECT_TRUE(recent_.NoteOpened({Folder("a"), "A", 10}).ok());
  EXPECT_TRUE(other.NoteOpened({Folder("b"), "B", 20}).ok());
  EXPECT_TRUE(recent_.Forget(Folder("a")).ok());
  EXPECT_THAT(Listed(), testing::ElementsAre("b"));
}

TEST_F(RecentProjectsTest, OneThatIsLocatedTakesTheOldPlaceInTheList) {
  EXPECT_TRUE(recent_.NoteOpened({Folder("moved"), "M", 10}).ok());
  EXPECT_TRUE(recent_.NoteOpened({Folder("b"), "B", 20}).ok());
  EXPECT_FALSE(IsProject(recent_.entries().back().folder));
  ASSERT_TRUE(CreateProject({Folder("found")}, "M").ok());
  EXPECT_TRUE(recent_.Move(Folder("moved"), Folder("found")).ok());
  EXPECT_THAT(Listed(), testing::ElementsAre("b", "found"));
  EXPECT_TRUE(IsProject(recent_.entries().back().folder));
}

TEST_F(RecentProjectsTest, TheOldestAreForgotten) {
  for (size_t i = 0; i < RecentProjects::kMost + 3; ++i) {
    const auto time = static_cast<int64_t>(i);
    ASSERT_TRUE(recent_.NoteOpened({Folder("p" + std::to_string(i)), "P", time}).ok());
  }
  EXPECT_EQ(Listed().size(), RecentProjects::kMost);
  EXPECT_EQ(Listed().back(), "p3");
}

class DamagedRecent : public RecentProjectsTest, public testing::WithParamInterface<const char*> {};

TEST_P(DamagedRecent, IsToldOfMovedAsideAndBegunAnew) {
  fs::create_directories(file_.parent_path());
  ASSERT_TRUE(WriteFileAtomically(file_, std::string_view(GetParam())).ok());
  const Status status = recent_.Reload();
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.message(), HasSubstr("recent.json"));
  EXPECT_TRUE(recent_.entries().empty());
  EXPECT_TRUE(fs::exists(file_.string() + ".damaged"));
  EXPECT_TRUE(recent_.NoteOpened({Folder("a"), "A", 10}).ok());
  EXPECT_THAT(Listed(), testing::ElementsAre("a"));
}

INSTANTIATE_TEST_SUITE_P(
    Files,
    DamagedRecent,
    testing::Values("",
                    "[]",
                    "{\"schema\": 1",
                    "{\"schema\": 2, \"recent\": []}",
                    "{\"schema\": 1, \"recent\": {}}",
                    "{\"schema\": 1, \"recent\": [7]}",
                    "{\"schema\": 1, \"recent\": [], \"more\": 1}",
                    R"({"schema": 1, "recent": [{"folder": "here", "title": "", "opened": 1}]})",
                    R"({"schema": 1, "recent": [{"folder": "/a", "title": 3, "opened": 1}]})",
                    R"({"schema": 1, "recent": [{"folder": "/a", "title": "", "opened": -1}]})"));

TEST(ProjectPicture, IsKeptSmallAndForgivesDamage) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(::setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), 0);
  const fs::path project = folder / "show.lararium";
  EXPECT_FALSE(LoadProjectPicture(project));
  ASSERT_TRUE(SaveProjectPicture(project, cv::Mat(720, 1280, CV_8UC3, cv::Scalar(1, 2, 200))).ok());
  const std::optional<cv::Mat> kept = LoadProjectPicture(folder / "x/../show.lararium");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->size(), cv::Size(480, 270));
  EXPECT_EQ(kept->at<cv::Vec3b>(100, 100), cv::Vec3b(1, 2, 200));
  EXPECT_FALSE(LoadProjectPicture(folder / "other.lararium"));
  for (const auto& entry : fs::directory_iterator(CacheFolder() / "projects")) {
    ASSERT_TRUE(WriteFileAtomically(entry.path(), std::string_view("no picture")).ok());
  }
  EXPECT_FALSE(LoadProjectPicture(project));
  ::unsetenv("XDG_CACHE_HOME");
}

TEST(UserFolders, RelativePathsOfTheEnvironmentAreIgnored) {
  ASSERT_EQ(::setenv("XDG_STATE_HOME", "relative", 1), 0);
  EXPECT_EQ(StateFolder(), HomeFolder() / ".local/state/lararium");
  ASSERT_EQ(::setenv("XDG_STATE_HOME", "/elsewhere", 1), 0);
  EXPECT_EQ(StateFolder(), "/elsewhere/lararium");
  ::unsetenv("XDG_STATE_HOME");
}

}  // namespace
}  // namespace lararium::editor
