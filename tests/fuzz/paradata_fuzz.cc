// libFuzzer harness: reading any text as paradata terminates, and accepted paradata reads back as
// it was written.

#include <string_view>

#include "shared/core/check.h"
#include "shared/stage/paradata.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::stage;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto paradata = ParseParadata(text, "fuzz.json");
  if (paradata.ok()) {
    const std::string written = FormatParadata(*paradata);
    const auto again = ParseParadata(written, "again.json");
    CHECK(again.ok());
    CHECK(FormatParadata(*again) == written);
  }
  return 0;
}
