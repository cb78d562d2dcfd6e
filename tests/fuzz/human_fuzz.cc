// libFuzzer harness: whatever the bytes are, parsing them ends, and what it
// accepts keeps every promise of human.h.

#include <cstddef>
#include <cstdint>
#include <span>

#include "shared/core/check.h"
#include "shared/human/human.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  const auto parsed = lararium::human::ParseHuman(bytes, "fuzz");
  CHECK(!parsed.ok() || parsed->Validate("fuzz").ok());
  return 0;
}
