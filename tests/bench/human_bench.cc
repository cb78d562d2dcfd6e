// Poses one person as the simulation does in each frame. The GPU skins; SkinMesh is its reference
// and is used for baking.

#include <benchmark/benchmark.h>

#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/human/human.h"
#include "shared/human/skinning.h"

namespace lararium::human {
namespace {

// A chain of joints with clips of random rotations, and a mesh around it.
Human MakeChain(size_t joints, size_t vertices) {
  Random random(1);
  Human human;
  Clip clip{"sway", 1.0f, 30.0f, true, 0.0f, {}};
  for (size_t i = 0; i < joints; ++i) {
    human.skeleton.names.push_back("joint" + std::to_string(i));
    human.skeleton.parents.push_back(static_cast<int16_t>(i) - 1);
    human.skeleton.rest.push_back({.translation = glm::vec3(0.0f, 0.05f, 0.0f)});
    human.skeleton.joint_from_actor.emplace_back(1.0f);
  }
  for (size_t key = 0; key < 31 * joints; ++key) {
    JointTransform transform = human.skeleton.rest[0];
    transform.rotation = glm::normalize(
        glm::quat(4.0f, glm::vec3{random.Normal(), random.Normal(), random.Normal()}));
    clip.keys.push_back(transform);
  }
  human.clips.push_back(clip);
  SkinnedMesh mesh;
  for (size_t v = 0; v < vertices; ++v) {
    const auto joint = [&] {
      return static_cast<uint8_t>(random.Below(static_cast<uint32_t>(joints)));
    };
    mesh.positions.push_back({random.Normal(), random.Normal(), random.Normal()});
    mesh.normals.push_back(glm::normalize(mesh.positions.back()));
    mesh.joints.push_back({joint(), joint(), joint(), joint()});
    mesh.weights.emplace_back(0.4f, 0.3f, 0.2f, 0.1f);
  }
  human.meshes.push_back(std::move(mesh));
  return human;
}

void BenchSampleClip(benchmark::State& state) {
  const Human human = MakeChain(static_cast<size_t>(state.range(0)), 1);
  std::vector<JointTransform> pose(human.skeleton.size());
  double time = 0.0;
  for (auto _ : state) {
    SampleClip(human.clips[0], time += 1.0 / 120.0, pose);
    benchmark::DoNotOptimize(pose.data());
  }
}
BENCHMARK(BenchSampleClip)->Arg(64);

void BenchComputeSkinMatrices(benchmark::State& state) {
  const Human human = MakeChain(static_cast<size_t>(state.range(0)), 1);
  std::vector<glm::mat4> actor_from_joint(human.skeleton.size()), skin(human.skeleton.size());
  for (auto _ : state) {
    ComputeActorFromJoint(human.skeleton, human.skeleton.rest, actor_from_joint);
    ComputeSkinMatrices(human.skeleton, actor_from_joint, skin);
    benchmark::DoNotOptimize(skin.data());
  }
}
BENCHMARK(BenchComputeSkinMatrices)->Arg(64);

void BenchSkinMesh(benchmark::State& state) {
  const auto vertices = static_cast<size_t>(state.range(0));
  const Human human = MakeChain(64, vertices);
  std::vector<glm::mat4> skin(64);
  ComputeActorFromJoint(human.skeleton, human.skeleton.rest, skin);
  std::vector<glm::vec3> positions(vertices), normals(vertices);
  for (auto _ : state) {
    SkinMesh(human.meshes[0], skin, positions, normals);
    benchmark::DoNotOptimize(positions.data());
  }
}
BENCHMARK(BenchSkinMesh)->Arg(50'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lararium::human
