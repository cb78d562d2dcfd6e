// libFuzzer harness: parsing any bytes as a prop terminates. An accepted prop keeps every promise
// of prop.h, can be written and read again, and its use is checked.

#include <span>

#include "shared/core/check.h"
#include "shared/stage/object.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::stage;
  auto prop = ParseProp(std::as_bytes(std::span(data, size)), "fuzz.larprop");
  if (prop.ok()) {
    CHECK(prop->Validate("fuzz.larprop").ok());
    CHECK(ParseProp(SerializeProp(*prop), "again.larprop").ok());
    const auto model = ObjectModel::Create(*std::move(prop), "fuzz.larprop");
    if (model.ok()) {
      Object object;
      object.model = *model;
      InitialState(object);
    }
  }
  return 0;
}
