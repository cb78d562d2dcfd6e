#include "editor/document/project_lock.h"

#include <gtest/gtest.h>

#include <utility>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

TEST(ProjectLock, OneWindowAtATimeHasAProject) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder.path()};
  {
    Result<ProjectLock> first = ProjectLock::Take(paths);
    ASSERT_TRUE(first.ok());
    const Result<ProjectLock> second = ProjectLock::Take(paths);
    ASSERT_FALSE(second.ok());
    EXPECT_NE(second.message().find("is open in another window ("), std::string::npos)
        << second.message();
    // A lock that moves stays held.
    const ProjectLock moved = std::move(*first);
    EXPECT_FALSE(ProjectLock::Take(paths).ok());
  }
  EXPECT_FALSE(FileExists(folder / ".open"));
  EXPECT_TRUE(ProjectLock::Take(paths).ok());
}

TEST(ProjectLock, AFolderThatIsNotThereIsNotReadOnly) {
  const test::TemporaryFolder folder;
  const Result<ProjectLock> lock = ProjectLock::Take({folder / "none"});
  ASSERT_TRUE(lock.ok());
  EXPECT_FALSE(lock->read_only());
}

}  // namespace
}  // namespace lararium::editor
