#include "editor/bake/prop_transfer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "shared/light/spherical_harmonics.h"
#include "tests/bake/test_things.h"

namespace lararium::bake {
namespace {

stage::Prop Bake(const stage::Prop& prop, const PropTransferOptions& options = {}) {
  auto lit = BakePropTransfer(*MakeModel(prop), options);
  CHECK(lit.ok());
  const Status valid = lit->Validate("here");
  EXPECT_TRUE(valid.ok()) << valid.message();
  return *std::move(lit);
}

// T_k of a vertex.
std::vector<float> Vector(const stage::Prop& prop, size_t mesh, size_t pose, size_t vertex) {
  const human::LightTransfer::Mesh& from = prop.light.meshes[mesh];
  const size_t row = pose * from.receivers.size() + vertex;
  const auto count = static_cast<size_t>(prop.light.count);
  std::vector<float> vector;
  for (size_t k = 0; k < count; ++k) {
    vector.push_back(from.scale[row] * static_cast<float>(from.coefficients[row * 3 * count + k]));
  }
  return vector;
}

// Irradiance divided by pi for a sky of radiance 1.
float UnderUniformSky(const stage::Prop& prop, size_t mesh, size_t pose, size_t vertex) {
  return Vector(prop, mesh, pose, vertex)[0] * std::sqrt(4.0f * kPiF) / kPiF;
}

TEST(PropTransfer, OfWhatNothingShadowsIsTheClampedCosine) {
  stage::Prop prop;
  prop.parts = {MakePart("ball", MakeCap({0, 1, 0}, 0.5f, kPiF, false, glm::vec3(0.5f), 12, 16))};
  const stage::Prop lit = Bake(prop, {.longest_edge = 1.0f});
  ASSERT_EQ(lit.light.key_poses.size(), 1u);
  EXPECT_EQ(lit.light_shown, std::vector<uint32_t>{1});
  const stage::PropMesh& mesh = lit.parts[0].meshes[0];
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto basis = light::EvaluateShBasis(mesh.normals[v]);
    const std::vector<float> vector = Vector(lit, 0, 0, v);
    float off = 0.0f;
    for (size_t k = 0; k < vector.size(); ++k) {
      const float expected =
          light::ClampedCosineFactor(light::ShBandOf(static_cast<int>(k))) * basis[k];
      off += (vector[k] - expected) * (vector[k] - expected);
    }
    EXPECT_LT(std::sqrt(off), 0.06f) << v;
  }
}

// A floor under a lid; the lid is a part that only one state shows.
stage::Prop MakeCovered() {
  stage::Prop prop;
  prop.parts = {MakePart("floor", MakeDisc({0, 0, 0}, {0, 1, 0}, 0.5f, glm::vec3(0.0f))),
                MakePart("lid", MakeBox({-2, 0.3f, -2}, {2, 0.4f, 2}, glm::vec3(0.0f)))};
  prop.use = R"({"schema": 1, "states": ["open", "covered"],
                 "parts": {"lid": {"states": ["covered"]}}})";
  return prop;
}

TEST(PropTransfer, EachStateThatShowsOtherPartsIsAKeyPose) {
  const stage::Prop lit = Bake(MakeCovered(), {.longest_edge = 10.0f});
  ASSERT_EQ(lit.light_shown, (std::vector<uint32_t>{1, 3}));
  // The middle of the floor is open in one state; in the other a lid hides most of the sky.
  EXPECT_NEAR(UnderUniformSky(lit, 0, 0, 0), 1.0f, 0.02f);
  EXPECT_LT(UnderUniformSky(lit, 0, 1, 0), 0.2f);
  // The lid has its own light at both key poses, whether it is shown or not.
  for (size_t v = 0; v < 4; ++v) {
    EXPECT_EQ(Vector(lit, 1, 0, v), Vector(lit, 1, 1, v));
  }
}

// A post whose foot is inside a block: the vertices there receive no light, and would darken
// the post up to its next vertices.
TEST(PropTransfer, WhatIsBuriedTakesTheLightOfItsNeighbours) {
  stage::Prop prop;
  prop.parts = {
      MakePart("post", MakeBox({-0.05f, 0.2f, -0.05f}, {0.05f, 1.0f, 0.05f}, glm::vec3(0.5f)))};
  prop.parts[0].meshes.push_back(
      ToPropMesh(MakeBox({-0.5f, 0.0f, -0.5f}, {0.5f, 0.4f, 0.5f}, glm::vec3(0.5f))));
  const stage::Prop lit = Bake(prop, {.longest_edge = 0.15f});
  const stage::PropMesh& post = lit.parts[0].meshes[0];
  for (size_t v = 0; v < post.positions.size(); ++v) {
    if (std::abs(post.normals[v].x) > 0.9f && post.positions[v].y > 0.3f) {
      EXPECT_GT(UnderUniformSky(lit, 0, 0, v), 0.35f) << post.positions[v].y;
    }
  }
}

TEST(PropTransfer, PartsThatTurnKeepTheirVectorsInTheirOwnFrame) {
  stage::Prop prop;
  prop.parts = {MakePart("leaf", MakeDisc({0, 0, 0}, {0, 0, -1}, 0.3f, glm::vec3(0.5f)))};
  prop.parts[0].parent_from_part = {{0, 1, 0}, glm::angleAxis(0.5f * kPiF, glm::vec3(1, 0, 0))};
  const stage::Prop lit = Bake(prop, {.longest_edge = 1.0f});
  // In its own frame the part faces -Z, independent of its rotation.
  const std::vector<float> vector = Vector(lit, 0, 0, 0);
  EXPECT_NEAR(vector[2], -2.0f * kPiF / 3.0f * std::sqrt(3.0f / (4.0f * kPiF)), 0.05f);
  EXPECT_NEAR(vector[1], 0.0f, 0.05f);
}

}  // namespace
}  // namespace lararium::bake
