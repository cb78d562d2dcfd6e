// Cost of mixing a block of ten milliseconds. Budget: a tenth of it, on its own thread.

#include <benchmark/benchmark.h>

#include <cmath>

#include "shared/audio/mixer.h"
#include "shared/audio/obstruction.h"
#include "tests/audio/test_sounds.h"

namespace lararium::audio {
namespace {

// A number of voices around a walking listener, a quarter of them streamed from FLAC.
void BenchMixer(benchmark::State& state) {
  const auto library = test::Library(
      {test::Sound("held", test::Encode(test::Noise(2.0), 1)),
       test::Sound("streamed", test::Encode(test::Noise(8.0), 1, 48'000, test::Coding::kFlac))});
  MixerOptions options;
  options.hrtf = state.range(1) != 0;
  const auto mixer = Mixer::Create(library, options);
  if (!mixer.ok()) {
    state.SkipWithError(mixer.message().c_str());
    return;
  }
  SoundScene scene;
  scene.reverb = stage::Reverb::kStoneRoom;
  for (int64_t i = 0; i < state.range(0); ++i) {
    Voice& voice = scene.voices.emplace_back();
    voice.source = static_cast<uint64_t>(i + 1);
    voice.clip = i % 4 == 3 ? 1 : 0;
    voice.loops = true;
    const auto angle = static_cast<float>(i);
    voice.position = {3.0f * std::cos(angle), 1.5f, 3.0f * std::sin(angle)};
  }
  std::vector<float> block(2 * Mixer::kBlockFrames);
  double time = 0.0;
  for (auto _ : state) {
    scene.listener.position.x = 0.1f * static_cast<float>(std::sin(time));
    (*mixer)->Render(scene, time, block);
    time += 0.01;
    benchmark::DoNotOptimize(block.data());
  }
  state.SetLabel((*mixer)->hrtf() ? "heads' filters" : "loudspeakers");
}
BENCHMARK(BenchMixer)->Args({8, 0})->Args({8, 1})->Args({32, 1})->Unit(benchmark::kMicrosecond);

// All rays of one frame: a number of voices and a wall of 20000 triangles.
void BenchObstruction(benchmark::State& state) {
  constexpr int kSide = 100;
  stage::Occluder wall;
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      wall.mesh.positions.emplace_back(0.05f * static_cast<float>(x - kSide / 2),
                                       0.03f * static_cast<float>(y), -1.0f);
    }
  }
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t i = y * (kSide + 1) + x;
      for (const uint32_t index : {i, i + 1, i + kSide + 2, i, i + kSide + 2, i + kSide + 1}) {
        wall.mesh.indices.push_back(index);
      }
    }
  }
  const SoundBlockers blockers(std::span(&wall, 1));
  for (auto _ : state) {
    for (int64_t i = 0; i < state.range(0); ++i) {
      benchmark::DoNotOptimize(blockers.Obstruction(
          {0.0f, 1.5f, 1.0f}, {0.3f * static_cast<float>(i % 20) - 3.0f, 1.5f, -3.0f}));
    }
  }
}
BENCHMARK(BenchObstruction)->Arg(32)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lararium::audio
