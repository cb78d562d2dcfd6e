// Mixing makes no allocations of our own in steady state. This is a separate program, because it
// replaces the global allocator.

#include <gtest/gtest.h>

#include "shared/audio/mixer.h"
#include "tests/audio/test_sounds.h"
#include "tests/support/allocation_counter.h"

namespace lararium::audio {
namespace {

TEST(Mixer, RenderingAllocatesNothing) {
  const auto library = test::Library({test::Sound("held", test::Encode(test::Noise(1.0), 1)),
                                      test::Sound("streamed", test::Encode(test::Noise(6.0), 1))});
  auto mixer = Mixer::Create(library, {});
  ASSERT_TRUE(mixer.ok());
  SoundScene scene;
  scene.reverb = stage::Reverb::kStoneRoom;
  for (uint64_t i = 0; i < 8; ++i) {
    Voice& voice = scene.voices.emplace_back();
    voice.source = i;
    voice.clip = static_cast<int>(i % 2);
    voice.loops = true;
    voice.position = {static_cast<float>(i), 0.0f, -2.0f};
  }
  std::vector<float> block(2 * Mixer::kBlockFrames);
  double time = 0.0;
  const auto render = [&] {
    scene.voices[0].position.x += 0.01f;
    scene.listener.position.z += 0.01f;
    (*mixer)->Render(scene, time, block);
    time += 0.01;
  };
  for (int i = 0; i < 20; ++i) {
    render();
  }
  test::AllocationCounter counter;
  constexpr int kBlocks = 200;
  for (int i = 0; i < kBlocks; ++i) {
    render();
  }
  // The OpenAL Soft of Debian 13 allocates a few times itself.
  EXPECT_LE(counter.Stop(), kBlocks / 10);
  EXPECT_EQ((*mixer)->playing(), 8u);
}

}  // namespace
}  // namespace lararium::audio
