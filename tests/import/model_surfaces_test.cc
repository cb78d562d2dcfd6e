#include "editor/import/model/model_surfaces.h"

#include <assimp/material.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

namespace lararium::import {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A scene with only materials, and a part for each used material.
class ReadSurfacesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.mMaterials = new aiMaterial*[kMost];  // The scene deletes them.
    model_.scene = &scene_;
    model_.file = "folder/figure.fbx";
  }

  aiMaterial& Add(const char* name, const aiColor3D& colour) {
    auto* material = new aiMaterial;
    const aiString text(name);
    material->AddProperty(&text, AI_MATKEY_NAME);
    material->AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
    scene_.mMaterials[scene_.mNumMaterials++] = material;
    return *material;
  }

  void Use(unsigned material) {
    meshes_.emplace_back().mMaterialIndex = material;
    parts_.emplace_back().mesh = &meshes_.back();
  }

  ModelSurfaces Read() { return ReadSurfaces(model_, parts_, true, notes_); }

  static constexpr size_t kMost = 8;
  aiScene scene_;
  ModelScene model_;
  std::deque<aiMesh> meshes_;
  std::vector<Part> parts_;
  std::vector<std::string> notes_;
};

TEST_F(ReadSurfacesTest, GivesThePlainColourToTheVerticesAndWhiteToTheMaterial) {
  Add("wall", {1.0f, 0.0f, 1.0f});
  Use(0);
  const ModelSurfaces surfaces = Read();
  ASSERT_EQ(surfaces.materials.size(), 1u);
  EXPECT_EQ(surfaces.materials[0].colour, glm::vec3(1.0f));
  EXPECT_EQ(surfaces.vertex_colours[0], glm::vec3(1.0f, 0.0f, 1.0f));
  EXPECT_EQ(surfaces.uses[0].colour, -1);
}

TEST_F(ReadSurfacesTest, TakesColoursForLinearInAGltfAndForSrgbElsewhere) {
  Add("wall", {0.5f, 0.5f, 0.5f});
  Use(0);
  EXPECT_NEAR(Read().vertex_colours[0].x, 0.21404f, 1e-4f);
  model_.gltf.emplace();
  EXPECT_EQ(Read().vertex_colours[0].x, 0.5f);
}

TEST_F(ReadSurfacesTest, ReadsEmissionThatNoTextureVaries) {
  const aiColor3D emission(0.5f, 0.0f, -1.0f);
  const aiString path("glow.png");
  Add("embers", {0.0f, 0.0f, 0.0f}).AddProperty(&emission, 1, AI_MATKEY_COLOR_EMISSIVE);
  aiMaterial& varied = Add("lamp", {0.0f, 0.0f, 0.0f});
  varied.AddProperty(&emission, 1, AI_MATKEY_COLOR_EMISSIVE);
  varied.AddProperty(&path, AI_MATKEY_TEXTURE_EMISSIVE(0));
  Use(0);
  Use(1);
  const ModelSurfaces surfaces = Read();
  EXPECT_NEAR(surfaces.emissions.at(0).x, 0.21404f, 1e-4f);
  EXPECT_EQ(surfaces.emissions[0].z, 0.0f);
  EXPECT_EQ(surfaces.emissions.at(1), glm::vec3(0.0f));
  model_.gltf.emplace();
  EXPECT_EQ(Read().emissions.at(0).x, 0.5f);
}

TEST_F(ReadSurfacesTest, ReadsOnlyTheMaterialsThatPartsUse) {
  Add("first", {0.1f, 0.1f, 0.1f});
  Add("second", {0.1f, 0.1f, 0.1f});
  Add("third", {0.1f, 0.1f, 0.1f});
  Use(2);
  Use(0);
  Use(2);
  Use(99);  // Does not exist.
  const ModelSurfaces surfaces = Read();
  ASSERT_EQ(surfaces.materials.size(), 2u);
  EXPECT_EQ(surfaces.materials[1].name, "third");
  EXPECT_THAT(surfaces.material_of, ElementsAre(0, human::Material::kNone, 1));
}

TEST_F(ReadSurfacesTest, KnowsSurfacesByTheWordsInTheirNames) {
  const std::pair<const char*, human::Surface> names[] = {
      {"Bip_HAIR_01", human::Surface::kHair},
      {"Iris.l", human::Surface::kEye},
      {"FaceSkin", human::Surface::kSkin},
      {"toga praetexta", human::Surface::kCloth},
      {"amphora", human::Surface::kPlain}};
  for (const auto& [name, surface] : names) {
    Use(scene_.mNumMaterials);
    Add(name, {0.1f, 0.1f, 0.1f});
  }
  const ModelSurfaces surfaces = Read();
  for (size_t i = 0; i < std::size(names); ++i) {
    EXPECT_EQ(surfaces.materials[i].surface, names[i].second) << names[i].first;
  }
}

TEST_F(ReadSurfacesTest, SaysOnceThatAnImageIsMissing) {
  const aiString path("C:\\textures\\skin.png");
  for (unsigned i = 0; i < 2; ++i) {
    Add("skin", {0.5f, 0.5f, 0.5f}).AddProperty(&path, AI_MATKEY_TEXTURE_DIFFUSE(0));
    Use(i);
  }
  const ModelSurfaces surfaces = Read();
  EXPECT_THAT(surfaces.images, IsEmpty());
  EXPECT_EQ(surfaces.uses[1].colour, -1);
  EXPECT_THAT(notes_, ElementsAre("texture C:\\textures\\skin.png: is not in the model's folder"));
}

TEST_F(ReadSurfacesTest, TakesAnEmbeddedImageOnceAndUntouched) {
  auto* texture = new aiTexture;
  texture->pcData = new aiTexel[2]{};
  texture->mWidth = 8;  // Number of bytes of an encoded image.
  texture->mFilename = "skin.png";
  scene_.mTextures = new aiTexture*[1];
  scene_.mTextures[0] = texture;
  scene_.mNumTextures = 1;
  const aiString path("*0");
  for (unsigned i = 0; i < 2; ++i) {
    Add("skin", {0.0f, 1.0f, 0.0f}).AddProperty(&path, AI_MATKEY_TEXTURE_DIFFUSE(0));
    Use(i);
  }
  const ModelSurfaces surfaces = Read();
  ASSERT_EQ(surfaces.images.size(), 1u);
  EXPECT_EQ(surfaces.images[0].name, "skin.png");
  EXPECT_EQ(surfaces.images[0].encoded.size(), 8u);
  EXPECT_EQ(surfaces.uses[0].colour, 0);
  EXPECT_EQ(surfaces.uses[1].colour, 0);
  EXPECT_EQ(surfaces.materials[0].colour, glm::vec3(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(surfaces.vertex_colours[0], glm::vec3(1.0f));
}

}  // namespace
}  // namespace lararium::import
