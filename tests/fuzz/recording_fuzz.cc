// libFuzzer harness: reading any bytes as a recording terminates, and what is read is finite.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "editor/bake/speech_sound.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto sound = lararium::bake::ReadSound(std::as_bytes(std::span(data, size)), "fuzz.wav");
  if (sound.ok()) {
    CHECK(!sound->samples.empty() && sound->rate > 0);
    for (const float sample : sound->samples) {
      CHECK(std::abs(sample) <= 1.0f);
    }
  }
  return 0;
}
