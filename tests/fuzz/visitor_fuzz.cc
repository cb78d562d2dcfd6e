// libFuzzer harness: any text as a visitor's log. A log that was read is written unchanged.

#include <string_view>

#include "shared/drama/visitor.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::drama;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto log = VisitorLog::Read(text, "fuzz");
  if (log.ok()) {
    const std::string written = log->Write();
    const auto again = VisitorLog::Read(written, "again");
    CHECK(again.ok());
    CHECK(again->Write() == written);
    CHECK(again->entries().size() == log->entries().size());
  }
  return 0;
}
