#include "editor/bake/posed_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/bake/test_surfaces.h"
#include "tests/support/png.h"

namespace lararium::bake {
namespace {

using ::testing::HasSubstr;

std::vector<SurfaceMesh> PoseOf(const human::Human& human, std::span<const glm::mat4> skin) {
  const auto surface = PosableSurface::Create(human);
  CHECK(surface.ok());
  return surface->Pose(skin);
}

std::vector<SurfaceMesh> BindPose(const human::Human& human) {
  return PoseOf(human, std::vector<glm::mat4>(human.skeleton.size(), glm::mat4(1.0f)));
}

human::Texture Encode(const cv::Mat& bgra) {
  human::Texture texture;
  texture.name = "texture";
  texture.encoded = test::Png(bgra);
  return texture;
}

TEST(PosedSurface, NormalsAreThoseOfTheTrianglesNotOfTheFile) {
  human::Human human =
      MakeRigidHuman({glm::vec3(0.0f)}, {{MakeSphere({0, 1, 0}, 0.5f, glm::vec3(0.5f)), 0}});
  const std::vector<glm::vec3> expected = human.meshes[0].normals;
  human.meshes[0].normals.assign(expected.size(), glm::normalize(glm::vec3(1, 1, 1)));
  // A seam is smooth only where the normals of the file agree; here no two vertices share a
  // position.
  const std::vector<SurfaceMesh> posed = BindPose(human);
  for (size_t v = 0; v < expected.size(); ++v) {
    EXPECT_GT(glm::dot(posed[0].normals[v], expected[v]), 0.995f) << v;
  }
}

TEST(PosedSurface, NormalsTurnWithTheBone) {
  const human::Human human = MakeRigidHuman({glm::vec3(0.0f), glm::vec3(0, 1, 0)},
                                            {{MakeSphere({0, 1, 0}, 0.5f, glm::vec3(0.5f)), 1}});
  const glm::mat4 turn = glm::mat4_cast(glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 3))));
  const std::vector<glm::mat4> skin = {glm::mat4(1.0f), turn};
  const std::vector<SurfaceMesh> bind = BindPose(human);
  const std::vector<SurfaceMesh> posed = PoseOf(human, skin);
  for (size_t v = 0; v < posed[0].normals.size(); ++v) {
    EXPECT_LT(glm::distance(posed[0].normals[v], glm::mat3(turn) * bind[0].normals[v]), 1e-4f);
    EXPECT_LT(glm::distance(posed[0].positions[v],
                            glm::vec3(turn * glm::vec4(bind[0].positions[v], 1.0f))),
              1e-5f);
  }
}

TEST(PosedSurface, SmoothSeamsShareNormalsAndEdgesKeepTheirOwn) {
  // A roof of two halves with split vertices along the ridge, at half a radian each: according
  // to the file, the ridge is smooth. And a box, whose edges are hard.
  SurfaceMesh roof;
  const glm::vec3 left = glm::normalize(glm::vec3(-0.5f, 1, 0));
  const glm::vec3 right = glm::normalize(glm::vec3(0.5f, 1, 0));
  for (const float z : {0.0f, 1.0f}) {
    AddVertex({0, 1, z}, left, glm::vec3(0.5f), roof);
    AddVertex({-2, 0, z}, left, glm::vec3(0.5f), roof);
    AddVertex({0, 1, z}, right, glm::vec3(0.5f), roof);
    AddVertex({2, 0, z}, right, glm::vec3(0.5f), roof);
  }
  AddTriangle(0, 1, 5, left, roof);
  AddTriangle(0, 5, 4, left, roof);
  AddTriangle(2, 3, 7, right, roof);
  AddTriangle(2, 7, 6, right, roof);
  const SurfaceMesh box = MakeBox({3, 0, 0}, {4, 1, 1}, glm::vec3(0.5f));
  const std::vector<SurfaceMesh> posed =
      BindPose(MakeRigidHuman({glm::vec3(0.0f)}, {{roof, 0}, {box, 0}}));
  EXPECT_EQ(posed[0].normals[0], posed[0].normals[2]);
  EXPECT_EQ(posed[0].normals[4], posed[0].normals[6]);
  EXPECT_GT(posed[0].normals[1].y, 0.8f);
  EXPECT_LT(glm::distance(posed[0].normals[1], left), 1e-5f);
  for (size_t v = 0; v < box.normals.size(); ++v) {
    EXPECT_LT(glm::distance(posed[1].normals[v], box.normals[v]), 1e-5f) << v;
  }
}

TEST(PosedSurface, AlbedoIsVertexTimesMaterialTimesTexture) {
  SurfaceMesh disc = MakeDisc({0, 1, 0}, {0, 1, 0}, 1.0f, {0.5f, 1.0f, 1.0f});
  for (size_t v = 0; v < disc.positions.size(); ++v) {
    disc.uvs.push_back({disc.positions[v].x > 0.0f ? 0.75f : 0.25f, 0.5f});
  }
  human::Human human = MakeRigidHuman({glm::vec3(0.0f)}, {{disc, 0}});
  // Blue, green, red, alpha; 188 is 0.5 in linear light.
  cv::Mat image(2, 2, CV_8UC4, cv::Scalar(255, 255, 188, 255));
  image.col(1) = cv::Scalar(0, 255, 255, 0);
  human.textures = {std::make_shared<const human::Texture>(Encode(image))};
  human::Material material;
  material.name = "skin";
  material.colour = {1.0f, 0.5f, 1.0f};
  material.colour_texture = 0;
  human.materials = {material};
  human.meshes[0].material = 0;
  ASSERT_TRUE(human.Validate("here").ok()) << human.Validate("here").message();
  std::vector<SurfaceMesh> posed = BindPose(human);
  const SurfaceMesh& mesh = posed[0];
  EXPECT_TRUE(mesh.coverage.empty());
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 expected =
        mesh.uvs[v].x > 0.5f ? glm::vec3(0.5f, 0.5f, 0.0f) : glm::vec3(0.25f, 0.5f, 1.0f);
    EXPECT_LT(glm::distance(mesh.AlbedoAt(v), expected), 0.01f) << v;
  }
  // Alpha counts only for a material with a cutoff.
  human.materials[0].alpha_cutoff = 0.5f;
  posed = BindPose(human);
  ASSERT_EQ(posed[0].coverage.size(), cv::Size(2, 2));
  EXPECT_EQ(posed[0].coverage.at<uint8_t>(1, 0), 255);
  EXPECT_EQ(posed[0].coverage.at<uint8_t>(0, 1), 0);
}

TEST(PosedSurface, ATextureThatIsNoImageIsRefusedByName) {
  human::Human human = MakeRigidHuman({glm::vec3(0.0f)},
                                      {{MakeDisc({0, 0, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.5f)), 0}});
  human.textures = {std::make_shared<const human::Texture>(
      human::Texture{"wool", std::vector<std::byte>(64, std::byte{0x89})})};
  const auto surface = PosableSurface::Create(human);
  ASSERT_FALSE(surface.ok());
  EXPECT_THAT(surface.message(), HasSubstr("wool"));
}

}  // namespace
}  // namespace lararium::bake
