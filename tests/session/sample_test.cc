#include "editor/session/sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/document/project.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

TEST(Sample, IsCopiedOnceAndThenKeptAsItWasEdited) {
  const test::TemporaryFolder folder;
  const std::filesystem::path shipped = folder / "shipped/small.lararium";
  ASSERT_TRUE(CreateProject({shipped}, "Small").ok());
  const Result<std::filesystem::path> own = OwnSample(shipped, folder / "mine");
  ASSERT_TRUE(own.ok()) << own.message();
  EXPECT_EQ(*own, folder / "mine/small.lararium");
  const Result<ProjectDocument> copied = LoadProject({*own});
  ASSERT_TRUE(copied.ok()) << copied.message();
  EXPECT_EQ(copied->title, "Small");

  ASSERT_TRUE(WriteFileAtomically(*own / "drama.lua", std::string_view("-- mine")).ok());
  ASSERT_TRUE(OwnSample(shipped, folder / "mine").ok());
  EXPECT_EQ(*ReadText(*own / "drama.lua"), "-- mine");
}

TEST(Sample, ACopyThatWasBrokenOffIsMadeAnew) {
  const test::TemporaryFolder folder;
  const std::filesystem::path shipped = folder / "shipped/small.lararium";
  ASSERT_TRUE(CreateProject({shipped}, "Small").ok());
  std::filesystem::create_directories(folder / "mine/small.lararium.part/places");
  ASSERT_TRUE(OwnSample(shipped, folder / "mine").ok());
  EXPECT_TRUE(LoadProject({folder / "mine/small.lararium"}).ok());
}

TEST(Sample, WithoutOneTheErrorSaysWhere) {
  const test::TemporaryFolder folder;
  const auto own = OwnSample(folder / "nowhere.lararium", folder / "mine");
  ASSERT_FALSE(own.ok());
  EXPECT_THAT(own.message(), testing::HasSubstr("nowhere.lararium"));
}

}  // namespace
}  // namespace lararium::editor
