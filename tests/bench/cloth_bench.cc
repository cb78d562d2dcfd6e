// Cloth and hair of one person, simulated as in each frame. Budget for five people with 700
// particles each, hair included: 3 ms a frame on one core.

#include <benchmark/benchmark.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "shared/human/cloth.h"
#include "shared/human/cloth_data.h"
#include "shared/human/spring.h"
#include "tests/human/walker.h"

namespace lararium::human {
namespace {

// Index of a frame when playing to the end and back without a jump.
size_t ThereAndBack(size_t frame, size_t count) {
  const size_t at = frame % (2 * count - 2);
  return at < count ? at : 2 * count - 2 - at;
}

// 720 particles over 11 capsules, walking. Argument: frames per second.
void BenchStepCloth(benchmark::State& bench) {
  const Human human = SkirtedWalker(36, 19);
  const ClothModel model(human);
  ClothState state(model);
  const auto rate = static_cast<double>(bench.range(0));
  std::vector<WalkerPose> poses(static_cast<size_t>(rate) * 6);
  for (size_t i = 0; i < poses.size(); ++i) {
    PoseWalker(human, static_cast<double>(i) / rate, poses[i]);
  }
  ClothStep step;
  step.elapsed = static_cast<float>(1.0 / rate);
  step.detail = static_cast<ClothDetail>(bench.range(1));
  step.wind.velocity = {1.0f, 0.0f, 0.5f};
  size_t frame = 0;
  for (auto _ : bench) {
    const WalkerPose& walker = poses[ThereAndBack(frame++, poses.size())];
    step.actor_from_joint = walker.actor_from_joint;
    step.stage_from_actor = walker.stage_from_actor;
    StepCloth(model, step, state);
    benchmark::DoNotOptimize(state.particles(0).data());
  }
}
BENCHMARK(BenchStepCloth)
    ->ArgNames({"fps", "detail"})
    ->ArgsProduct({{25, 60}, {0, 1, 2}})
    ->Unit(benchmark::kMicrosecond);

// The same edges and hinges as a plain loop: one constraint after another in the mesh's order,
// hinges by their dihedral angle (Mueller et al., "Position Based Dynamics", 2007); four steps, no
// body, nothing else.
void BenchPlainConstraints(benchmark::State& bench) {
  const Human human = SkirtedWalker(36, 19);
  const ClothModel model(human);
  const ClothModel::Data& data = model.data();
  std::vector<glm::vec3> x;
  for (const Float4& p : data.rest) {
    x.push_back(p.xyz());
  }
  const auto bend = [&](const ClothHinge& h) {
    const auto [i0, i1, i2, i3] = h.particles;
    const glm::vec3 p2 = x[i1] - x[i0], p3 = x[i2] - x[i0], p4 = x[i3] - x[i0];
    const glm::vec3 n1 = glm::normalize(glm::cross(p2, p3));
    const glm::vec3 n2 = glm::normalize(glm::cross(p2, p4));
    const float d = glm::clamp(glm::dot(n1, n2), -1.0f, 1.0f);
    const float l3 = glm::length(glm::cross(p2, p3)) + 1e-9f;
    const float l4 = glm::length(glm::cross(p2, p4)) + 1e-9f;
    const glm::vec3 q3 = (glm::cross(p2, n2) + glm::cross(n1, p2) * d) / l3;
    const glm::vec3 q4 = (glm::cross(p2, n1) + glm::cross(n2, p2) * d) / l4;
    const glm::vec3 q2 = -(glm::cross(p3, n2) + glm::cross(n1, p3) * d) / l3 -
                         (glm::cross(p4, n1) + glm::cross(n2, p4) * d) / l4;
    const glm::vec3 q1 = -q2 - q3 - q4;
    const float weight = glm::dot(q1, q1) + glm::dot(q2, q2) + glm::dot(q3, q3) + glm::dot(q4, q4);
    const float s = -1e-3f * std::sqrt(1.0f - d * d) * (std::acos(d) - h.rest) / (weight + 1e-9f);
    x[i0] += s * q1;
    x[i1] += s * q2;
    x[i2] += s * q3;
    x[i3] += s * q4;
  };
  for (auto _ : bench) {
    for (int step = 0; step < 4; ++step) {
      for (const ClothHinge& hinge : data.hinges) {
        bend(hinge);
      }
      for (const ClothEdge& edge : data.edges) {
        const glm::vec3 along = x[edge.b] - x[edge.a];
        const float length = glm::length(along);
        const glm::vec3 pull = along * (0.5f * (length - edge.length) / length);
        x[edge.a] += pull;
        x[edge.b] -= pull;
      }
    }
    benchmark::DoNotOptimize(x.data());
  }
}
BENCHMARK(BenchPlainConstraints)->Unit(benchmark::kMicrosecond);

void BenchDrapeMesh(benchmark::State& bench) {
  const Human human = SkirtedWalker(36, 19);
  const ClothModel model(human);
  const ClothState state(model);
  const std::vector<glm::mat4> skin(human.skeleton.size(), glm::mat4(1.0f));
  std::vector<glm::vec3> positions(human.meshes[0].positions.size());
  std::vector<glm::vec3> normals(positions.size());
  for (auto _ : bench) {
    DrapeMesh(model, state, 0, human.meshes[0], skin, positions, normals);
    benchmark::DoNotOptimize(positions.data());
  }
  bench.SetItemsProcessed(bench.iterations() * static_cast<int64_t>(positions.size()));
}
BENCHMARK(BenchDrapeMesh)->Unit(benchmark::kMicrosecond);

// Four locks of five joints on the walker's chest, at 60 frames a second.
void BenchStepSprings(benchmark::State& bench) {
  Human human = SkirtedWalker(8, 3);
  for (int lock = 0; lock < 4; ++lock) {
    SpringChain chain;
    for (int i = 0; i < 5; ++i) {
      chain.joints.push_back(static_cast<uint32_t>(human.skeleton.size()));
      human.skeleton.names.push_back("lock" + std::to_string(lock) + std::to_string(i));
      human.skeleton.parents.push_back(i == 0 ? int16_t{1}
                                              : static_cast<int16_t>(human.skeleton.size() - 2));
      human.skeleton.rest.push_back({.translation = {0.03f * float(lock), -0.05f, 0.15f}});
      human.skeleton.joint_from_actor.emplace_back(1.0f);
    }
    human.springs.push_back(chain);
  }
  const SpringModel model(human);
  SpringState state(model);
  SpringStep step;
  step.elapsed = 1.0f / 60.0f;
  std::vector<WalkerPose> poses(360);
  for (size_t i = 0; i < poses.size(); ++i) {
    PoseWalker(human, static_cast<double>(i) / 60.0, poses[i]);
  }
  std::vector<JointTransform> pose(human.skeleton.size());
  std::vector<glm::mat4> actor_from_joint(pose.size());
  size_t frame = 0;
  for (auto _ : bench) {
    const WalkerPose& walker = poses[ThereAndBack(frame++, poses.size())];
    step.stage_from_actor = walker.stage_from_actor;
    pose = walker.pose;
    actor_from_joint = walker.actor_from_joint;
    StepSprings(model, step, state, pose, actor_from_joint);
    benchmark::DoNotOptimize(pose.data());
  }
}
BENCHMARK(BenchStepSprings)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lararium::human
