#include "tests/human/walker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "shared/core/units.h"

namespace lararium::human {
namespace {
constexpr float kRest = 0.35f;  // share of a thigh in the skirt's skin

void AddJoint(Human& human, const std::string& name, int16_t parent, const glm::vec3& place) {
  glm::vec3 from_parent = place;
  for (int16_t p = parent; p != Skeleton::kNoParent; p = human.skeleton.parents[p]) {
    from_parent -= human.skeleton.rest[p].translation;
  }
  human.skeleton.names.push_back(name);
  human.skeleton.parents.push_back(parent);
  human.skeleton.rest.push_back({.translation = from_parent});
  human.skeleton.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -place));
}

// A mesh whose vertices are the particles of a cloth.
SkinnedMesh MeshOf(const Cloth& cloth) {
  SkinnedMesh mesh;
  mesh.name = cloth.name;
  mesh.positions = cloth.positions;
  mesh.normals.assign(cloth.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
  mesh.albedo.assign(cloth.positions.size(), glm::vec3(0.5f));
  mesh.joints = cloth.joints;
  mesh.weights = cloth.weights;
  mesh.indices = cloth.triangles;
  return mesh;
}

void BindToItself(Cloth& cloth) {
  cloth.vertex_triangle.assign(cloth.positions.size(), Cloth::kUnbound);
  cloth.vertex_weights.assign(cloth.positions.size(), glm::vec3(0.0f));
  for (uint32_t k = 0; k < cloth.triangles.size(); ++k) {
    const uint32_t v = cloth.triangles[k];
    cloth.vertex_triangle[v] = k / 3;
    cloth.vertex_weights[v] = {k % 3 == 0 ? 1.0f : 0.0f, k % 3 == 1 ? 1.0f : 0.0f, 0.0f};
  }
}

void AddQuad(Cloth& cloth, uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool turned) {
  const std::array<uint32_t, 6> corners = turned ? std::array<uint32_t, 6>{a, d, b, b, d, c}
                                                 : std::array<uint32_t, 6>{a, d, c, a, c, b};
  cloth.triangles.insert(cloth.triangles.end(), corners.begin(), corners.end());
}

Cloth Skirt(int columns, int rows) {
  Cloth cloth;
  cloth.name = "skirt";
  for (int row = 0; row <= rows; ++row) {
    const float down = static_cast<float>(row) / static_cast<float>(rows);
    for (int column = 0; column < columns; ++column) {
      const float angle = 2.0f * kPiF * static_cast<float>(column) / static_cast<float>(columns);
      const float x = std::sin(angle);
      const float z = std::cos(angle);
      cloth.positions.emplace_back((0.215f + 0.13f * down) * x, 1.02f - 0.72f * down,
                                   (0.155f + 0.17f * down) * z);
      const float thigh = down * kRest * std::abs(x);
      cloth.joints.push_back({0, x < 0.0f ? uint8_t{2} : uint8_t{4}, 0, 0});
      cloth.weights.emplace_back(1.0f - thigh, thigh, 0.0f, 0.0f);
      cloth.reach.push_back(row == 0 ? 0.0f : 0.05f + 0.5f * down);
    }
  }
  const auto n = static_cast<uint32_t>(columns);
  for (uint32_t row = 0; row < static_cast<uint32_t>(rows); ++row) {
    for (uint32_t column = 0; column < n; ++column) {
      const uint32_t next = (column + 1) % n;
      AddQuad(cloth, row * n + column, row * n + next, (row + 1) * n + next, (row + 1) * n + column,
              (row + column) % 2 == 0);
    }
  }
  BindToItself(cloth);
  return cloth;
}

JointTransform Turned(JointTransform joint, float angle, const glm::vec3& axis) {
  joint.rotation = glm::angleAxis(angle, axis);
  return joint;
}

}  // namespace

Human OneJointHuman() {
  Human human;
  human.name = "one joint";
  AddJoint(human, "humanoid_root", Skeleton::kNoParent, glm::vec3(0.0f));
  return human;
}

Cloth Sheet(int columns, int rows, float cell, float top) {
  Cloth cloth;
  cloth.name = "sheet";
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      cloth.positions.emplace_back(cell * static_cast<float>(column),
                                   top - cell * static_cast<float>(row), 0.0f);
    }
  }
  const size_t count = cloth.positions.size();
  cloth.joints.assign(count, {0, 0, 0, 0});
  cloth.weights.assign(count, {1, 0, 0, 0});
  cloth.reach.assign(count, 100.0f);
  const auto width = static_cast<uint32_t>(columns) + 1;
  for (uint32_t row = 0; row < static_cast<uint32_t>(rows); ++row) {
    for (uint32_t column = 0; column + 1 < width; ++column) {
      const uint32_t a = row * width + column;
      AddQuad(cloth, a, a + 1, a + 1 + width, a + width, (row + column) % 2 == 0);
    }
  }
  BindToItself(cloth);
  return cloth;
}

Human SkirtedWalker(int columns, int rows) {
  Human human;
  human.name = "walker";
  AddJoint(human, "humanoid_root", Skeleton::kNoParent, {0.0f, 0.95f, 0.0f});
  AddJoint(human, "vl5", 0, {0.0f, 1.1f, 0.0f});
  AddJoint(human, "l_hip", 0, {-0.09f, 0.9f, 0.0f});
  AddJoint(human, "l_knee", 2, {-0.09f, 0.5f, 0.0f});
  AddJoint(human, "r_hip", 0, {0.09f, 0.9f, 0.0f});
  AddJoint(human, "r_knee", 4, {0.09f, 0.5f, 0.0f});
  AddJoint(human, "l_shoulder", 1, {-0.19f, 1.42f, 0.0f});
  AddJoint(human, "l_elbow", 6, {-0.24f, 1.14f, 0.0f});
  AddJoint(human, "r_shoulder", 1, {0.19f, 1.42f, 0.0f});
  AddJoint(human, "r_elbow", 8, {0.24f, 1.14f, 0.0f});
  human.capsules = {{0, {-0.07f, -0.02f, 0.0f}, {0.07f, -0.02f, 0.0f}, 0.115f, 0.115f},
                    {0, {-0.05f, 0.1f, 0.0f}, {0.05f, 0.1f, 0.0f}, 0.105f, 0.105f},
                    {1, {-0.05f, 0.2f, 0.0f}, {0.05f, 0.2f, 0.0f}, 0.12f, 0.12f},
                    {2, {0.0f, 0.0f, 0.0f}, {0.0f, -0.4f, 0.0f}, 0.085f, 0.055f},
                    {3, {0.0f, 0.0f, 0.0f}, {0.0f, -0.42f, 0.0f}, 0.055f, 0.035f},
                    {4, {0.0f, 0.0f, 0.0f}, {0.0f, -0.4f, 0.0f}, 0.085f, 0.055f},
                    {5, {0.0f, 0.0f, 0.0f}, {0.0f, -0.42f, 0.0f}, 0.055f, 0.035f},
                    {6, {0.0f, 0.0f, 0.0f}, {-0.05f, -0.28f, 0.0f}, 0.05f, 0.04f},
                    {7, {0.0f, 0.0f, 0.0f}, {-0.03f, -0.25f, 0.0f}, 0.04f, 0.03f},
                    {8, {0.0f, 0.0f, 0.0f}, {0.05f, -0.28f, 0.0f}, 0.05f, 0.04f},
                    {9, {0.0f, 0.0f, 0.0f}, {0.03f, -0.25f, 0.0f}, 0.04f, 0.03f}};
  human.cloths.push_back(Skirt(columns, rows));
  human.meshes.push_back(MeshOf(human.cloths[0]));
  return human;
}

void PoseWalker(const Human& human, double time, WalkerPose& walker) {
  constexpr float kSpeed = 1.3f;
  constexpr float kRadius = 2.0f;
  const auto seconds = static_cast<float>(std::fmod(time, 600.0));
  // The walker stands for three of every ten seconds and acts then.
  const float in_round = std::fmod(seconds, 10.0f);
  const float standing = std::clamp(std::min(in_round - 6.5f, 10.0f - in_round) * 2.0f, 0.0f, 1.0f);
  const float act = standing * standing * (3.0f - 2.0f * standing);
  const int round = static_cast<int>(seconds / 10.0f) % 3;
  const float bow = round == 0 ? act : 0.0f;
  const float crouch = round == 1 ? act : 0.0f;
  const float lift = round == 2 ? act : 0.0f;
  const float stride = 1.0f - act;
  const float phase = 2.0f * kPiF * 0.95f * seconds;
  const glm::vec3 x(1.0f, 0.0f, 0.0f);
  std::vector<JointTransform>& pose = walker.pose;
  pose = human.skeleton.rest;
  pose[0].translation.y += 0.02f * stride * std::cos(2.0f * phase) - 0.32f * crouch;
  pose[1] = Turned(pose[1], -0.9f * bow, x);
  for (int side = 0; side < 2; ++side) {
    const float leg = phase + kPiF * static_cast<float>(side);
    const float swing = stride * 0.45f * std::sin(leg);
    const float knee = stride * (0.45f + 0.45f * std::sin(leg + 1.2f));
    pose[2 + 2 * side] = Turned(pose[2 + 2 * side], swing + 1.1f * crouch, x);
    pose[3 + 2 * side] = Turned(pose[3 + 2 * side], -knee - 1.9f * crouch, x);
    pose[6 + 2 * side] = Turned(pose[6 + 2 * side], -0.8f * swing + 2.4f * lift + 0.9f * bow, x);
    pose[7 + 2 * side] = Turned(pose[7 + 2 * side], 0.3f, x);
  }
  walker.actor_from_joint.resize(human.skeleton.size());
  ComputeActorFromJoint(human.skeleton, pose, walker.actor_from_joint);
  // Distance along the circle: the integral of the speed without the pauses.
  const float walked = std::floor(seconds / 10.0f) * 7.25f + std::min(in_round, 7.25f);
  const float angle = kSpeed * walked / kRadius;
  walker.stage_from_actor = glm::rotate(glm::mat4(1.0f), angle, glm::vec3(0.0f, 1.0f, 0.0f)) *
                            glm::translate(glm::mat4(1.0f), glm::vec3(kRadius, 0.0f, 0.0f));
}

float DeepestPenetration(const Human& human,
                         std::span<const glm::vec3> particles,
                         std::span<const glm::mat4> actor_from_joint) {
  constexpr glm::vec3 kSamples[] = {{1, 0, 0},
                                    {0, 1, 0},
                                    {0, 0, 1},
                                    {0.5f, 0.5f, 0},
                                    {0, 0.5f, 0.5f},
                                    {0.5f, 0, 0.5f},
                                    {1 / 3.0f, 1 / 3.0f, 1 / 3.0f}};
  const std::vector<uint32_t>& triangles = human.cloths[0].triangles;
  float deepest = 0.0f;
  for (const BodyCapsule& capsule : human.capsules) {
    const glm::vec3 a(actor_from_joint[capsule.joint] * glm::vec4(capsule.a, 1.0f));
    const glm::vec3 b(actor_from_joint[capsule.joint] * glm::vec4(capsule.b, 1.0f));
    for (size_t t = 0; t < triangles.size(); t += 3) {
      for (const glm::vec3& w : kSamples) {
        const glm::vec3 p = w.x * particles[triangles[t]] + w.y * particles[triangles[t + 1]] +
                            w.z * particles[triangles[t + 2]];
        const float share = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
        const float radius = capsule.radius_a + share * (capsule.radius_b - capsule.radius_a);
        deepest = std::max(deepest, radius - glm::length(p - a - share * (b - a)));
      }
    }
  }
  return deepest;
}

}  // namespace lararium::human
