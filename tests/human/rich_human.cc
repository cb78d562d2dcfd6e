#include "tests/human/rich_human.h"

#include "tests/human/two_joint_human.h"

namespace lararium::human {

Human RichHuman() {
  Human human = TwoJointHuman();
  human.skinning = Skinning::kDualQuaternion;
  const std::string png = "\x89PNG and so on";
  Texture texture{.name = "wool", .encoded = {}};
  for (const char c : png) {
    texture.encoded.push_back(static_cast<std::byte>(c));
  }
  human.textures = {std::make_shared<const Texture>(std::move(texture))};
  human.materials = {
      {"wool", Surface::kCloth, 0, Material::kNone, {0.5f, 0.25f, 1.0f}, 0.75f, 0.5f, true}};
  SkinnedMesh& mesh = human.meshes[0];
  mesh.material = 0;
  mesh.uvs = {{0.0f, 0.0f}, {0.5f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}};
  mesh.coarser = {{0.01f, {0, 1, 3}}, {0.5f, {}}};
  human.morphs = {{"jaw", {{0, {1, 3}, {{0, -1, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 1, 0}}}}}};
  human.face = {{"aa", {{0, 0.75f}}, {{1, glm::quat(0.6f, 0.8f, 0.0f, 0.0f)}}}};
  Cloth cloth;
  cloth.name = "hem";
  cloth.positions = {{0, 1, 0}, {1, 1, 0}, {0, 0, 0}};
  cloth.joints.assign(3, {0, 1, 0, 0});
  cloth.weights.assign(3, glm::vec4(0.25f, 0.75f, 0.0f, 0.0f));
  cloth.reach = {0.0f, 0.0f, 0.5f};
  cloth.triangles = {0, 1, 2};
  cloth.vertex_triangle = {0, 0, Cloth::kUnbound, 0};
  cloth.vertex_weights.assign(4, glm::vec3(0.5f, 0.25f, 0.01f));
  cloth.density = 0.3f;
  cloth.friction = 0.2f;
  human.cloths = {cloth};
  human.springs = {{"plait", {0, 1}, 5.0f, 2.0f, 0.5f, 0.01f}};
  human.capsules = {{1, {0, 0, 0}, {1, 0, 0}, 0.06f, 0.04f}};
  LightTransfer& light = human.light;
  light.count = 9;
  light.bounces = 2;
  light.key_poses = {human.skeleton.rest, human.skeleton.rest};
  light.key_poses[1][1].rotation = glm::quat(0.6f, 0.8f, 0.0f, 0.0f);
  light.blockers = {{0, {0.5f, 1.0f, 0.0f}, 0.1f}, {1, {1.5f, 1.0f, 0.0f}, 0.08f}};
  light.receivers = {{0, {0, 1.12f, 0}}, {0, {1, 1.12f, 0}}, {1, {2, 1.12f, 0}}};
  light.meshes.resize(1);
  light.meshes[0].receivers = {{0, 0, 0, 0}, {1, 2, 0, 0}, {2, 1, 0, 0}, {2, 1, 0, 2}};
  light.meshes[0].weights = {{255, 0, 0, 0}, {200, 55, 0, 0}, {128, 127, 0, 0}, {100, 80, 60, 15}};
  light.meshes[0].backs = {{0, 10, 255}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  for (int i = 0; i < 2 * 4 * 3 * 9; ++i) {
    light.meshes[0].coefficients.push_back(static_cast<int8_t>(i * 37 % 255 - 127));
  }
  for (int i = 0; i < 2 * 4; ++i) {
    light.meshes[0].scale.push_back(0.01f * static_cast<float>(i));
  }
  return human;
}

}  // namespace lararium::human
