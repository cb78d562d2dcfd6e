#include "tests/human/two_joint_human.h"

#include <glm/gtc/matrix_transform.hpp>

#include "shared/core/units.h"

namespace lararium::human {
namespace {

Clip MakeClip(const Human& human,
              const std::string& name,
              float duration,
              bool loops,
              size_t joint,
              const glm::vec3& axis,
              float angle) {
  Clip clip{name, duration, 4.0f, loops, 0.0f, {}};
  const int intervals = static_cast<int>(duration * 4.0f);
  for (int key = 0; key <= intervals; ++key) {
    std::vector<JointTransform> pose = human.skeleton.rest;
    const float share = static_cast<float>(key) / static_cast<float>(intervals);
    pose[joint].rotation = glm::angleAxis(share * angle, axis);
    clip.keys.insert(clip.keys.end(), pose.begin(), pose.end());
  }
  return clip;
}

}  // namespace

Human TwoJointHuman() {
  Human human;
  human.name = "two joints";
  human.credits = "made for the tests";
  human.skeleton.names = {"l_shoulder", "l_elbow"};
  human.skeleton.parents = {Skeleton::kNoParent, 0};
  human.skeleton.rest.resize(2);
  human.skeleton.rest[0].translation = glm::vec3(0.0f, 1.0f, 0.0f);
  human.skeleton.rest[1].translation = glm::vec3(1.0f, 0.0f, 0.0f);
  human.skeleton.joint_from_actor = {
      glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, -1.0f, 0.0f)),
      glm::translate(glm::mat4(1.0f), glm::vec3(-1.0f, -1.0f, 0.0f))};
  SkinnedMesh mesh;
  mesh.name = "sleeve";
  mesh.positions = {{0.0f, 1.1f, 0.0f}, {1.0f, 1.1f, 0.0f}, {2.0f, 1.1f, 0.0f}, {2.0f, 0.9f, 0.0f}};
  mesh.normals.assign(4, glm::vec3(0.0f, 1.0f, 0.0f));
  mesh.albedo.assign(4, glm::vec3(0.5f, 0.25f, 0.125f));
  mesh.joints = {{0, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
  mesh.weights = {{1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
  mesh.indices = {0, 1, 2, 1, 3, 2};
  human.meshes.push_back(mesh);
  human.clips = {MakeClip(human, "bend", 1.0f, false, 1, {0, 0, 1}, kPiF / 2.0f),
                 MakeClip(human, "turn", 2.0f, true, 0, {0, 1, 0}, 2.0f * kPiF)};
  human.clips[1].stride = 1.25f;
  return human;
}

}  // namespace lararium::human
