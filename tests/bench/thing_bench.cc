// Lighting of twenty objects of a street kitchen with five people among them. Budget: 0.1 ms of one
// core while nothing near has moved, 1 ms a frame while people walk.

#include <benchmark/benchmark.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "shared/core/random.h"
#include "shared/show/stage_light.h"
#include "shared/show/thing_light.h"

namespace lararium::show {
namespace {

constexpr size_t kThings = 20;
constexpr size_t kThingPeople = 5;
constexpr size_t kThingVertices = 1500;
constexpr uint16_t kThingReceivers = 32;

// A jar with the data that lighting needs.
stage::Prop MakeJar(Random& random) {
  stage::Prop prop;
  stage::PropPart& part = prop.parts.emplace_back();
  part.name = "jar";
  stage::PropMesh& mesh = part.meshes.emplace_back();
  human::LightTransfer& light = prop.light;
  light.count = 16;
  light.key_poses.resize(1, std::vector<human::JointTransform>(1));
  prop.light_shown = {1};
  const auto direction = [&] {
    return glm::normalize(
        glm::vec3{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)});
  };
  for (uint16_t i = 0; i < kThingReceivers; ++i) {
    light.receivers.push_back({0, 0.22f * direction()});
  }
  human::LightTransfer::Mesh& lit = light.meshes.emplace_back();
  for (size_t v = 0; v < kThingVertices; ++v) {
    mesh.positions.push_back(0.2f * direction());
    mesh.indices.push_back(static_cast<uint32_t>(v));
    const auto first = static_cast<uint16_t>(random.Below(kThingReceivers - 3));
    lit.receivers.push_back({first, static_cast<uint16_t>(first + 1),
                             static_cast<uint16_t>(first + 2), static_cast<uint16_t>(first + 3)});
    lit.weights.push_back({120, 70, 40, 25});
    lit.scale.push_back(0.01f);
    for (int i = 0; i < 3 * 16; ++i) {
      lit.coefficients.push_back(static_cast<int8_t>(static_cast<int>(random.Below(255)) - 127));
    }
  }
  return prop;
}

// A person who only casts shadows.
std::shared_ptr<const human::Human> MakeShade(Random& random) {
  auto human = std::make_shared<human::Human>();
  human->skeleton.names = {"root"};
  human->skeleton.parents = {human::Skeleton::kNoParent};
  human->skeleton.rest.resize(1);
  human->skeleton.joint_from_actor = {glm::mat4(1.0f)};
  human->light.count = 9;
  human->light.key_poses = {human->skeleton.rest};
  for (int i = 0; i < 56; ++i) {
    human->light.blockers.push_back(
        {0,
         {random.Uniform(-0.3, 0.3), random.Uniform(0.1, 1.7), random.Uniform(-0.2, 0.2)},
         0.08f});
  }
  return human;
}

struct Kitchen {
  std::vector<std::shared_ptr<const human::Human>> cast;
  std::vector<glm::mat4> places;
  std::vector<glm::mat4> skin = {glm::mat4(1.0f)};
  std::vector<std::vector<glm::vec3>> irradiance;
  std::vector<ThingMemory> memories;
  light::ShRgb sky = {};

  Kitchen() {
    Random random(1);
    sky[0] = glm::vec3(3.0f);
    for (size_t i = 0; i < kThings + kThingPeople; ++i) {
      const bool is_thing = i < kThings;
      cast.push_back(is_thing ? FigureOf(MakeJar(random)) : MakeShade(random));
      irradiance.emplace_back(is_thing ? kThingVertices : 0);
      memories.emplace_back(0.25f);
      places.push_back(glm::translate(
          glm::mat4(1.0f), glm::vec3{random.Uniform(-3, 3), is_thing ? random.Uniform(0, 1) : 0.0,
                                     random.Uniform(-3, 3)}));
    }
  }
};

// Argument: metres that each person moves in a frame.
void BenchThings(benchmark::State& bench) {
  Kitchen kitchen;
  StageLight stage(kitchen.cast);
  std::vector<LitActor> actors(kitchen.cast.size());
  const float step = 0.001f * static_cast<float>(bench.range(0));
  float walked = 0.0f;
  int64_t lit = 0;
  for (auto _ : bench) {
    walked += step;
    for (uint32_t i = 0; i < actors.size(); ++i) {
      glm::mat4 place = kitchen.places[i];
      place[3].x += i < kThings ? 0.0f : std::sin(walked);
      actors[i] = {i, &kitchen.sky, kitchen.skin, place, kitchen.irradiance[i]};
    }
    stage.Pose(actors);
    for (size_t i = 0; i < kThings; ++i) {
      if (!kitchen.memories[i].Update(kitchen.sky, {}, kitchen.places[i], kitchen.skin,
                                      stage.blockers())) {
        actors[i].irradiance = {};
      } else {
        ++lit;
      }
    }
    stage.Light({}, actors);
  }
  bench.counters["lit"] = static_cast<double>(lit) / static_cast<double>(bench.iterations());
}
BENCHMARK(BenchThings)
    ->Arg(0)
    ->Arg(2)
    ->Arg(40)
    ->Unit(benchmark::kMicrosecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace lararium::show
