// libFuzzer harness: parsing any bytes as a map terminates, and an accepted map keeps every promise
// of scene_database.h.

#include <cstddef>
#include <cstdint>
#include <span>

#include "shared/core/check.h"
#include "shared/vision/scene_database.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  const auto parsed = lararium::vision::ParseSceneDatabase(bytes, "fuzz");
  CHECK(!parsed.ok() || parsed->Validate().ok());
  return 0;
}
