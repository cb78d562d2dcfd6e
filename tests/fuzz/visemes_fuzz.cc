// libFuzzer harness: reading any text as visemes terminates, and an accepted track is valid and has
// weights at any time.

#include <string_view>

#include "shared/core/check.h"
#include "shared/stage/viseme_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto track = lararium::stage::ParseVisemes(text, "fuzz.visemes.json");
  if (track.ok()) {
    CHECK(track->Validate("fuzz.visemes.json").ok());
    for (const double time : {-1.0, 0.0, 0.5, 1e9}) {
      float sum = 0.0f;
      for (const float share : lararium::human::SampleVisemes(*track, time)) {
        CHECK(share >= 0.0f && share <= 1.0f);
        sum += share;
      }
      CHECK(sum <= 1.001f);
    }
  }
  return 0;
}
