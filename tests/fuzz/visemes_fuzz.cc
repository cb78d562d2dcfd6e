#include <string_view>

#include "shared/stage/viseme_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto track = lararium::stage::ParseVisemes(text, "fuzz.visemes.json");
  if (track.ok()) {
    lararium::human::SampleVisemes(*track, 0.5);
  }
  return 0;
}
