// Lighting of five people in one frame: blockers, receivers, vertices. Budget: 3 ms of one core, at
// the demo's levels of detail.

#include <benchmark/benchmark.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "shared/core/parallel.h"
#include "shared/core/random.h"
#include "shared/human/skinning.h"
#include "shared/show/stage_light.h"
#include "tests/human/full_body.h"

namespace lararium::show {
namespace {

constexpr size_t kPeople = 5;
constexpr size_t kVertices = 40'000;
constexpr size_t kPoses = 7;
constexpr size_t kPersonReceivers = 240;
constexpr size_t kBlockers = 56;
constexpr float kCoarse = 0.01f;  // Allows the coarse level.

glm::vec3 Near(const glm::vec3& point, Random& random) {
  const auto offset = [&] { return static_cast<float>(random.Uniform(-0.12, 0.12)); };
  return point + glm::vec3(offset(), offset(), offset());
}

// A human with as much light data as the baker produces, in the same form; transfer values are
// random.
human::Human LitHuman(int divisor) {
  Random random(54);
  human::Human human = human::FullBody(0.3f, 0);
  std::vector<glm::vec3> joints;
  for (const glm::mat4& joint_from_actor : human.skeleton.joint_from_actor) {
    joints.emplace_back(glm::inverse(joint_from_actor)[3]);
  }
  human::SkinnedMesh mesh;
  mesh.name = "skin";
  mesh.positions.resize(kVertices);
  mesh.indices = {0, 1, kVertices - 1};
  mesh.coarser = {{kCoarse, {0, 1, static_cast<uint32_t>(kVertices) / divisor - 1}}};
  human.meshes = {mesh};
  human::LightTransfer& light = human.light;
  light.count = 16;
  for (size_t pose = 0; pose < kPoses; ++pose) {
    light.key_poses.push_back(human.skeleton.rest);
    for (human::JointTransform& joint : light.key_poses.back()) {
      joint.rotation = glm::angleAxis(static_cast<float>(random.Uniform(-0.5, 0.5)),
                                      glm::normalize(Near(glm::vec3(0.0f), random)));
    }
  }
  for (size_t i = 0; i < kBlockers; ++i) {
    const auto joint = static_cast<uint32_t>(i % joints.size());
    light.blockers.push_back({joint, Near(joints[joint], random), 0.07f});
  }
  for (size_t i = 0; i < kPersonReceivers; ++i) {
    const auto joint = static_cast<uint32_t>(i * joints.size() / kPersonReceivers);
    light.receivers.push_back({joint, Near(joints[joint], random)});
  }
  light.meshes.resize(1);
  human::LightTransfer::Mesh& lit = light.meshes[0];
  for (size_t v = 0; v < kVertices; ++v) {
    const size_t near = v * (kPersonReceivers - 16) / kVertices;
    auto& receivers = lit.receivers.emplace_back();
    for (uint16_t& receiver : receivers) {
      receiver = static_cast<uint16_t>(near + random.Below(16));
    }
  }
  lit.weights.assign(kVertices, {120, 80, 40, 15});
  lit.scale.assign(kPoses * kVertices, 0.01f);
  lit.coefficients.resize(kPoses * kVertices * 48);
  for (int8_t& value : lit.coefficients) {
    value = static_cast<int8_t>(random.Next() & 127);
  }
  return human;
}

// Rotates each joint's matrix, as when limbs move over several frames.
std::vector<glm::mat4> Moved(const std::vector<glm::mat4>& skin, float radians) {
  std::vector<glm::mat4> moved;
  for (size_t joint = 0; joint < skin.size(); ++joint) {
    const glm::vec3 axis = glm::normalize(glm::vec3(1.0f, static_cast<float>(joint % 3), 0.5f));
    moved.push_back(glm::rotate(skin[joint], radians, axis));
  }
  return moved;
}

// Arguments: one of how many vertices is drawn; rotation of limbs and body per frame in
// milliradians (20: walking, 1: standing).
void BenchStageLight(benchmark::State& bench) {
  const auto human =
      std::make_shared<const human::Human>(LitHuman(static_cast<int>(bench.range(0))));
  const std::vector<std::shared_ptr<const human::Human>> cast(kPeople, human);
  StageLight stage_light(cast);
  const std::vector<glm::mat4> pose =
      human::SkinOfPose(human->skeleton, human->light.key_poses.back());
  // Moves to and fro over sixteen frames.
  const float step = 0.001f * static_cast<float>(bench.range(1));
  std::vector<std::vector<glm::mat4>> skins;
  for (int i = 0; i < 16; ++i) {
    skins.push_back(Moved(pose, step * static_cast<float>(i < 8 ? i : 16 - i)));
  }
  std::vector<std::vector<glm::vec3>> irradiance(kPeople, std::vector<glm::vec3>(kVertices));
  light::ShRgb light;
  Random random(55);
  for (glm::vec3& coefficient : light) {
    coefficient = glm::vec3{random.Normal(), random.Normal(), random.Normal()};
  }
  std::vector<LitActor> actors;
  for (size_t i = 0; i < kPeople; ++i) {
    const glm::vec3 place(static_cast<float>(i % 3), 0.0f, static_cast<float>(i / 3));
    actors.push_back({static_cast<uint32_t>(i), &light, skins[0],
                      glm::translate(glm::mat4(1.0f), place), irradiance[i], kCoarse});
  }
  const ThreadLimit one_core(1);
  size_t frame = 0;
  for (auto _ : bench) {
    ++frame;
    for (LitActor& actor : actors) {
      actor.skin = skins[frame % skins.size()];
      const float turn = frame / 32 % 2 == 0 ? step : -step;
      actor.stage_from_actor = glm::rotate(actor.stage_from_actor, turn, glm::vec3(0, 1, 0));
    }
    stage_light.Pose(actors);
    stage_light.Light({}, actors);
    benchmark::DoNotOptimize(irradiance.data());
  }
}
BENCHMARK(BenchStageLight)->ArgsProduct({{1, 2, 4, 400}, {20, 1}})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lararium::show
