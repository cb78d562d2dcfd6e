#include <span>

#include "shared/stage/prop.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto prop =
      lararium::stage::ParseProp(std::as_bytes(std::span(data, size)), "fuzz.larprop");
  if (prop.ok()) {
    CHECK(prop->Validate("fuzz.larprop").ok());
  }
  return 0;
}
