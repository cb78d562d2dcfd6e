#include "editor/import/model_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;

constexpr char kCube[] = R"(
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
f 1 2 3 4
)";

class ModelImport : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, std::string_view content) {
    EXPECT_TRUE(WriteFileAtomically(folder_ / name, content).ok());
    return folder_ / name;
  }
  test::TemporaryFolder folder_;
};

TEST_F(ModelImport, SplitsPolygonsIntoTriangles) {
  const auto mesh = ImportMesh(Write("quad.obj", kCube));
  ASSERT_TRUE(mesh.ok()) << mesh.message();
  EXPECT_EQ(mesh->indices.size(), 6u);
  EXPECT_NEAR(mesh->normals[0].z, 1.0f, 1e-6f);
}

TEST_F(ModelImport, RefusesFilesThatAreNoModels) {
  for (const char* name : {"a.glb", "a.gltf", "a.fbx", "a.obj", "a.dae", "a.xyz"}) {
    for (const std::string_view content :
         {std::string_view(""), std::string_view("garbage"), std::string_view("{}"),
          std::string_view("glTF\x02\0\0\0\xff\xff\xff\xff", 12),
          std::string_view("Kaydara FBX Binary  \0\x1a\0\xff\xff\xff\xff", 27)}) {
      const auto file = Write(name, content);
      const auto mesh = ImportMesh(file);
      ASSERT_FALSE(mesh.ok()) << name;
      EXPECT_THAT(mesh.message(), HasSubstr(name));
      EXPECT_FALSE(ImportHuman(file).ok());
    }
  }
  EXPECT_FALSE(ImportMesh(folder_ / "absent.glb").ok());
}

TEST_F(ModelImport, AskForAnArmatureWhereThereIsNone) {
  const auto human = ImportHuman(Write("quad.obj", kCube));
  ASSERT_FALSE(human.ok());
  EXPECT_THAT(human.message(), HasSubstr("skeleton"));
}

TEST_F(ModelImport, RefusesImpossibleOptions) {
  const auto file = Write("quad.obj", kCube);
  EXPECT_FALSE(ImportHuman(file, {.name = "", .credits = "", .metres_per_unit = 0.0f}).ok());
}

}  // namespace
}  // namespace lararium::import
