// Lighting at run time. Budgets on one core: shadows of 60 spheres on 1280 receivers (five people)
// well below 1.5 ms with 16 coefficients; 125 000 vertices lit in 3 ms.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "shared/core/random.h"
#include "shared/light/blocker_table.h"
#include "shared/light/key_poses.h"
#include "shared/light/lamp.h"
#include "shared/light/probe_blend.h"
#include "shared/light/receivers.h"
#include "shared/light/transfer.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

constexpr size_t kReceivers = 1280;

// Five people on a floor of six by six metres: twelve spheres each, with receivers near them.
struct Crowd {
  std::vector<float> x, y, z, radius;  // Spheres.
  std::vector<float> px, py, pz;       // Receivers.

  Crowd() {
    Random random(51);
    for (int person = 0; person < 5; ++person) {
      const double at_x = random.Uniform(-3, 3), at_z = random.Uniform(-3, 3);
      for (int i = 0; i < 12; ++i) {
        x.push_back(static_cast<float>(at_x + random.Uniform(-0.3, 0.3)));
        y.push_back(static_cast<float>(random.Uniform(0.1, 1.7)));
        z.push_back(static_cast<float>(at_z + random.Uniform(-0.3, 0.3)));
        radius.push_back(static_cast<float>(random.Uniform(0.06, 0.18)));
      }
      for (size_t i = 0; i < kReceivers / 5; ++i) {
        px.push_back(static_cast<float>(at_x + random.Uniform(-0.4, 0.4)));
        py.push_back(static_cast<float>(random.Uniform(0.0, 1.8)));
        pz.push_back(static_cast<float>(at_z + random.Uniform(-0.4, 0.4)));
      }
    }
  }
  Spheres spheres() const { return {x, y, z, radius}; }
  Points points() const { return {px, py, pz}; }
};

ShRgb SomeLight() {
  Random random(52);
  ShRgb light;
  for (glm::vec3& coefficient : light) {
    coefficient = glm::vec3{random.Normal(), random.Normal(), random.Normal()};
  }
  return light;
}

ShRowsRgb RgbRows(int count) {
  return {ShRows(count, kReceivers), ShRows(count, kReceivers), ShRows(count, kReceivers)};
}

// A brazier among the crowd, partly hidden by the spheres.
void BenchLamp(benchmark::State& bench) {
  const Crowd crowd;
  const auto count = static_cast<int>(bench.range(0));
  const ShRows own_log(count, kReceivers);
  ShRowsRgb radiance = RgbRows(count);
  const Lamp lamp = {{0.0f, 0.4f, 0.0f}, {2.0f, 1.0f, 0.3f}, 0.14f};
  for (auto _ : bench) {
    for (size_t person = 0; person < 5; ++person) {
      const ReceiverRange range = {person * kReceivers / 5, (person + 1) * kReceivers / 5};
      AddLamps({&lamp, 1}, crowd.points(), own_log, crowd.spheres(), range, radiance);
    }
    benchmark::DoNotOptimize(radiance[0].at(0, 0));
  }
}
BENCHMARK(BenchLamp)->Arg(9)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

void BenchBlendProbes(benchmark::State& bench) {
  std::vector<PlacedProbe> probes(static_cast<size_t>(bench.range(0)));
  for (size_t i = 0; i < probes.size(); ++i) {
    probes[i].position.x = static_cast<float>(i / 2);
    probes[i].hour = i % 2 == 0 ? 9.0 : 17.0;
    probes[i].light.sky = SomeLight();
  }
  for (auto _ : bench) {
    benchmark::DoNotOptimize(Blend(probes, {0.7f, 0.0f, 1.0f}, 11.0));
  }
}
BENCHMARK(BenchBlendProbes)->Arg(1)->Arg(8)->Unit(benchmark::kMicrosecond);

void BenchLogVisibility(benchmark::State& bench) {
  const Crowd crowd;
  ShRows log(static_cast<int>(bench.range(0)), kReceivers);
  for (auto _ : bench) {
    ClearLogVisibility({0, kReceivers}, log);
    AddLogVisibility(crowd.spheres(), crowd.points(), {0, kReceivers}, log);
    benchmark::DoNotOptimize(log.row(0));
  }
}
BENCHMARK(BenchLogVisibility)->Arg(9)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

void BenchExponential(benchmark::State& bench) {
  const Crowd crowd;
  const int count = static_cast<int>(bench.range(0));
  ShRows log(count, kReceivers), visibility(count, kReceivers);
  AddLogVisibility(crowd.spheres(), crowd.points(), {0, kReceivers}, log);
  for (auto _ : bench) {
    ExpRows(log, visibility);
    benchmark::DoNotOptimize(visibility.row(0));
  }
}
BENCHMARK(BenchExponential)->Arg(9)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

// Log visibility, exponential, and product with the light.
void BenchShadowedReceivers(benchmark::State& bench) {
  const Crowd crowd;
  const int count = static_cast<int>(bench.range(0));
  const LightMatrix light(SomeLight(), count);
  ShRows log(count, kReceivers);
  ShRowsRgb shadowed = RgbRows(count);
  for (auto _ : bench) {
    ClearLogVisibility({0, kReceivers}, log);
    AddLogVisibility(crowd.spheres(), crowd.points(), {0, kReceivers}, log);
    ShadowLight(light, log, {0, kReceivers}, shadowed);
    benchmark::DoNotOptimize(shadowed[0].row(0));
  }
}
BENCHMARK(BenchShadowedReceivers)->Arg(9)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

// Rotates light into the frames of a number of receivers.
void BenchTurnReceivers(benchmark::State& bench) {
  const auto count = static_cast<int>(bench.range(0));
  const glm::quat turn = glm::normalize(glm::quat(0.3f, 0.5f, -0.2f, 0.7f));
  const std::vector<float> w(kReceivers, turn.w), x(kReceivers, turn.x), y(kReceivers, turn.y),
      z(kReceivers, turn.z);
  const ShRowsRgb source = RgbRows(count);
  ShRowsRgb target = RgbRows(count);
  for (auto _ : bench) {
    TurnRows(source, {w, x, y, z}, TurnDirection::kBack, {0, kReceivers}, target);
    benchmark::DoNotOptimize(target[0].row(0));
  }
}
BENCHMARK(BenchTurnReceivers)->Arg(9)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

void BenchLightMatrix(benchmark::State& bench) {
  const ShRgb light = SomeLight();
  for (auto _ : bench) {
    const LightMatrix matrix(light, static_cast<int>(bench.range(0)));
    benchmark::DoNotOptimize(matrix.channel(0));
  }
}
BENCHMARK(BenchLightMatrix)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

// Five people of 25 000 vertices, with five key poses of which two have weights.
void BenchLightVertices(benchmark::State& bench) {
  constexpr size_t kVertices = 125000, kPoses = 5;
  const int count = static_cast<int>(bench.range(0));
  Random random(53);
  TransferBytes bytes = QuantiseTransfer(
      std::vector<float>(kPoses * kVertices * 3 * static_cast<size_t>(count), 0.5f), count, kPoses);
  for (int8_t& value : bytes.values) {
    value = static_cast<int8_t>(random.Next() & 127);
  }
  const Transfer transfer(bytes);
  std::vector<VertexReceivers> receivers(kVertices);
  for (size_t v = 0; v < kVertices; ++v) {
    const size_t near = v * (kReceivers - 16) / kVertices;
    for (uint16_t& receiver : receivers[v].receiver) {
      receiver = static_cast<uint16_t>(near + random.Below(16));
    }
    receivers[v].weight = {120, 80, 40, 15};
  }
  const ReceiverLight light(count, kReceivers);
  std::vector<float> weights(kReceivers * kMaxKeyPoses, 0.0f);
  for (size_t i = 0; i < kReceivers; ++i) {
    weights[i * kMaxKeyPoses + 1] = 0.7f;
    weights[i * kMaxKeyPoses + 3] = 0.3f;
  }
  std::vector<glm::vec3> irradiance(kVertices);
  const LightVerticesJob job{&transfer, receivers, &light, weights, irradiance};
  for (auto _ : bench) {
    job.Run(0, kVertices);
    benchmark::DoNotOptimize(irradiance.data());
  }
}
BENCHMARK(BenchLightVertices)->Arg(9)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

void BenchPackReceiverLight(benchmark::State& bench) {
  const int count = static_cast<int>(bench.range(0));
  const ShRowsRgb light = RgbRows(count);
  ReceiverLight packed(count, kReceivers);
  for (auto _ : bench) {
    PackReceiverLight(light, packed);
    benchmark::DoNotOptimize(packed.row(0));
  }
}
BENCHMARK(BenchPackReceiverLight)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

void BenchKeyPoses(benchmark::State& bench) {
  const Crowd crowd;
  const int count = static_cast<int>(bench.range(0));
  std::vector<ShRows> keys(5, ShRows(count, kReceivers));
  ShRows now(count, kReceivers), delta(count, kReceivers);
  AddLogVisibility(crowd.spheres(), crowd.points(), {0, kReceivers}, now);
  std::vector<float> weights(kReceivers * kMaxKeyPoses);
  for (auto _ : bench) {
    KeyPoseWeights(keys, now, {}, {0, kReceivers}, weights);
    SubtractKeyPoses(keys, now, weights, {0, kReceivers}, delta);
    benchmark::DoNotOptimize(delta.row(0));
  }
}
BENCHMARK(BenchKeyPoses)->Arg(16)->Arg(25)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lararium::light
