#include "editor/app/workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::app {
namespace {

using testing::HasSubstr;

class WorkspaceTest : public testing::Test {
 protected:
  WorkspaceTest() { CHECK(CreateProject(paths_, "Before").ok()); }

  std::unique_ptr<Workspace> Open() {
    Result<std::unique_ptr<Workspace>> workspace = Workspace::Open(paths_, *log_);
    CHECK(workspace.ok());
    return std::move(*workspace);
  }

  static void SetTitle(Workspace& workspace, const std::string& title) {
    workspace.Edit("title", [&](ProjectDocument& document) { document.title = title; });
  }

  std::string SavedTitle() {
    const Result<ProjectDocument> document = LoadProject(paths_);
    return document.ok() ? document->title : document.message();
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "show.lararium"};
  std::shared_ptr<Log> log_ = MakeSilentLog();
};

TEST_F(WorkspaceTest, SavesWhatWasEditedAndUndone) {
  const auto workspace = Open();
  SetTitle(*workspace, "One");
  SetTitle(*workspace, "Two");
  workspace->Undo();
  EXPECT_EQ(SavedTitle(), "Before");
  workspace->Save();
  EXPECT_EQ(SavedTitle(), "One");
  workspace->Redo();
  EXPECT_TRUE(workspace->commands().dirty());
  workspace->Save();
  EXPECT_EQ(SavedTitle(), "Two");
}

TEST_F(WorkspaceTest, RecoversUnsavedEditsAndUndoTakesThemBack) {
  ProjectDocument edited;
  edited.title = "Unsaved";
  ASSERT_TRUE(SaveJson(paths_.Autosave(), FormatProject(edited)).ok());
  const auto workspace = Open();
  EXPECT_EQ(workspace->document().title, "Unsaved");
  EXPECT_TRUE(workspace->commands().dirty());
  EXPECT_THAT(workspace->messages().back().text, HasSubstr("recovered"));
  workspace->Undo();
  EXPECT_EQ(workspace->document().title, "Before");
}

TEST_F(WorkspaceTest, OpensBesideADamagedAutosaveAndSaysSo) {
  ASSERT_TRUE(WriteFileAtomically(paths_.Autosave(), "{").ok());
  const auto workspace = Open();
  EXPECT_EQ(workspace->document().title, "Before");
  EXPECT_THAT(workspace->messages().front().text, HasSubstr("autosave.json"));
}

TEST_F(WorkspaceTest, LeavesAnAutosaveOfEditsThatWereNotSaved) {
  {
    const auto workspace = Open();
    SetTitle(*workspace, "Edited");
  }
  const auto left = LoadAutosave(paths_);
  ASSERT_TRUE(left.ok());
  ASSERT_TRUE(left->has_value());
  EXPECT_EQ((*left)->title, "Edited");
}

TEST_F(WorkspaceTest, AFailedExportIsAMessageAndWritesNothing) {
  const auto workspace = Open();
  const std::filesystem::path out = folder_ / "show.larshow";
  workspace->Export(out);
  while (!workspace->tasks_empty()) {
    workspace->Update(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(workspace->messages().back().level, Message::Level::kError);
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace lararium::app
