#include "editor/import/objects/object_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ObjectLibraryTest : public ::testing::Test {
 protected:
  void Write(const std::string& name) {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    EXPECT_TRUE(WriteFileAtomically(file, std::string_view("{}")).ok());
  }
  auto Find(const char* name) { return FindLibraryObject(name, folder_.path()); }

  test::TemporaryFolder folder_;
};

TEST_F(ObjectLibraryTest, NamesEachFolderAndNothingElse) {
  EXPECT_THAT(LibraryObjectNames(folder_ / "none"), IsEmpty());
  Write("README.md");
  Write("shrine/shrine.glb");
  Write("altar/altar.glb");
  Write(".trash/old.glb");
  EXPECT_THAT(LibraryObjectNames(folder_.path()), ElementsAre("altar", "shrine"));
}

TEST_F(ObjectLibraryTest, FindsTheModelAndWithoutOneTheUseOfARealObject) {
  Write("altar/altar.object.json");
  EXPECT_EQ(Find("altar").value(), folder_ / "altar/altar.object.json");
  Write("altar/altar.fbx");
  EXPECT_EQ(Find("altar").value(), folder_ / "altar/altar.fbx");
  Write("altar/altar.glb");
  EXPECT_EQ(Find("altar").value(), folder_ / "altar/altar.glb");
}

TEST_F(ObjectLibraryTest, SaysWhatIsMissingAndWhatToDo) {
  EXPECT_THAT(Find("altar").message(), HasSubstr("install the editor again"));
  Write("shrine/other.glb");
  EXPECT_THAT(Find("altar").message(), HasSubstr("\"altar\""));
  EXPECT_THAT(Find("altar").message(), HasSubstr("name one of shrine"));
  EXPECT_THAT(Find("shrine/../shrine").message(), HasSubstr("is not in the library"));
  EXPECT_THAT(Find("shrine").message(), HasSubstr((folder_ / "shrine").string()));
  EXPECT_THAT(Find("shrine").message(), HasSubstr("shrine.glb"));
}

}  // namespace
}  // namespace lararium::import
