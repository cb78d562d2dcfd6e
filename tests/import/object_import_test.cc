#include "editor/import/objects/object_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/core/file.h"
#include "tests/import/glb_figure.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ObjectImport : public ::testing::Test {
 protected:
  ObjectImport() {
    lamp_.json = {
        {"asset", {{"version", "2.0"}}},
        {"accessors", Json::array()},
        {"bufferViews", Json::array()},
        {"nodes",
         {{{"name", "lamp"}, {"mesh", 0}, {"children", {1}}}, {{"name", "flame"}, {"mesh", 1}}}},
        {"materials",
         {{{"name", "bronze"},
           {"doubleSided", true},
           {"pbrMetallicRoughness", {{"metallicFactor", 1.0}, {"roughnessFactor", 0.25}}}},
          {{"name", "fire"}, {"emissiveFactor", {1.0, 0.5, 0.25}}}}}};
    const size_t positions = lamp_.AddFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    const size_t colours = lamp_.AddFloats({1, 0, 0, 0, 1, 0, 0, 0, 0.5f}, 3);
    lamp_.json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}}, {"material", 0}}}}},
        {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"material", 1}}}}}};
  }

  Result<stage::Prop> Import() {
    EXPECT_TRUE(WriteFileAtomically(folder_ / "lamp.glb", lamp_.Glb()).ok());
    EXPECT_TRUE(
        WriteFileAtomically(folder_ / "lamp.object.json", std::string_view("{\"schema\": 1}"))
            .ok());
    notes_.clear();
    return ImportObject(folder_ / "lamp.glb", notes_);
  }

  test::TemporaryFolder folder_;
  test::GlbFigure lamp_;
  std::vector<std::string> notes_;
};

TEST_F(ObjectImport, NamesOfMaterialsMakeNoSkin) {
  lamp_.json["materials"][1]["name"] = "Surface of the lamp's head";
  const auto prop = Import();
  ASSERT_TRUE(prop.ok()) << prop.message();
  ASSERT_EQ(prop->materials.size(), 2u);
  EXPECT_EQ(prop->materials[1].surface, human::Surface::kPlain);
}

TEST_F(ObjectImport, TakesTheSurfaceOfEachPart) {
  const auto prop = Import();
  ASSERT_TRUE(prop.ok()) << prop.message();
  EXPECT_THAT(notes_, IsEmpty());
  ASSERT_EQ(prop->parts.size(), 2u);
  EXPECT_EQ(prop->parts[1].parent, 0);
  const stage::PropMesh& body = prop->parts[0].meshes.at(0);
  EXPECT_EQ(body.albedo[1], glm::vec3(0, 1, 0));
  EXPECT_EQ(body.albedo[2], glm::vec3(0, 0, 0.5f));
  EXPECT_EQ(body.emission, glm::vec3(0.0f));
  const human::Material& bronze = prop->materials.at(static_cast<size_t>(body.material));
  EXPECT_EQ(bronze.surface, human::Surface::kMetal);
  EXPECT_EQ(bronze.roughness, 0.25f);
  EXPECT_TRUE(bronze.two_sided);
  EXPECT_EQ(prop->parts[1].meshes.at(0).emission, glm::vec3(1.0f, 0.5f, 0.25f));
}

TEST_F(ObjectImport, ShinesBrighterThanWhiteWhereItsFileSaysHowStrongly) {
  lamp_.json["materials"][1]["extensions"]["KHR_materials_emissive_strength"] = {
      {"emissiveStrength", 4.0}};
  const auto prop = Import();
  ASSERT_TRUE(prop.ok()) << prop.message();
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_EQ(prop->parts[1].meshes.at(0).emission, glm::vec3(4.0f, 2.0f, 1.0f));
}

TEST_F(ObjectImport, SaysThatItTakesNoTextureOfEmission) {
  lamp_.json["materials"][1]["emissiveTexture"] = {{"index", 0}};
  const auto prop = Import();
  ASSERT_TRUE(prop.ok()) << prop.message();
  EXPECT_THAT(notes_, Contains(HasSubstr("textures of emission")));
  EXPECT_EQ(prop->parts[1].meshes.at(0).emission, glm::vec3(0.0f));
}

TEST_F(ObjectImport, NamesTheFileThatIsDamaged) {
  ASSERT_TRUE(Import().ok());
  std::vector<std::byte> bytes = lamp_.Glb();
  bytes.resize(bytes.size() / 2);
  ASSERT_TRUE(WriteFileAtomically(folder_ / "lamp.glb", bytes).ok());
  EXPECT_THAT(ImportObject(folder_ / "lamp.glb", notes_).message(), HasSubstr("lamp.glb"));
}

}  // namespace
}  // namespace lararium::import
