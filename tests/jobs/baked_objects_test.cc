// Objects are baked from their files: those of the library and those of the project.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/document/project.h"
#include "editor/import/objects/object_library.h"
#include "editor/jobs/baking.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class BakedObjects : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(CreateProject(paths_, "test").ok());
    document_ = LoadProject(paths_).value();
    std::filesystem::copy(import::ObjectLibrary() / "oil_lamp", paths_.folder / "lamps");
    document_.objects.resize(2);
    document_.objects[0].name = "old";
    document_.objects[0].model = "oil_lamp";
    document_.objects[1].name = "own";
    document_.objects[1].file = "lamps/oil_lamp.glb";
  }

  BakeReport Baked() {
    const auto report = Bake(paths_, document_, progress_);
    EXPECT_TRUE(report.ok()) << report.status().message();
    return report.ok() ? *report : BakeReport();
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "test.lararium"};
  ProjectDocument document_;
  NoProgress progress_;
};

TEST_F(BakedObjects, AreBakedAgainWhereTheirFilesChanged) {
  const BakeReport first = Baked();
  EXPECT_THAT(first.baked, ElementsAre("object old", "object own"));
  EXPECT_THAT(first.warnings, IsEmpty());
  for (const ObjectDocument& object : document_.objects) {
    const auto prop = LoadBakedProp(paths_, object);
    ASSERT_TRUE(prop.ok()) << prop.message();
    EXPECT_GT(prop->parts.at(1).meshes.at(0).emission.x, 1.0f) << "the flame";
    EXPECT_FALSE(prop->light.empty());
  }
  EXPECT_THAT(Baked().baked, IsEmpty());
  const std::filesystem::path use = paths_.folder / "lamps" / "oil_lamp.object.json";
  ASSERT_TRUE(WriteFileAtomically(use, std::string_view("{\"schema\": 1}")).ok());
  EXPECT_THAT(Baked().baked, ElementsAre("object own"));
  EXPECT_EQ(LoadBakedProp(paths_, document_.objects[1])->use, "{\"schema\": 1}");
}

TEST_F(BakedObjects, SayWhatIsWrongWithTheirFiles) {
  document_.objects[0].model = "spaceship";
  EXPECT_THAT(Bake(paths_, document_, progress_).message(),
              AllOf(HasSubstr("\"spaceship\""), HasSubstr("name one of amphora")));
  document_.objects.erase(document_.objects.begin());
  const std::filesystem::path model = paths_.folder / "lamps" / "oil_lamp.glb";
  std::filesystem::resize_file(model, 1000);
  EXPECT_THAT(Bake(paths_, document_, progress_).message(), HasSubstr(model.string()));
  std::filesystem::remove(model);
  EXPECT_THAT(Bake(paths_, document_, progress_).message(), HasSubstr(model.string()));
}

}  // namespace
}  // namespace lararium::editor
