// libFuzzer harness: any packet as Open Sound Control. Accepted messages can be kept in a visitor's
// log.

#include "player/app/osc.h"
#include "shared/core/check.h"
#include "shared/drama/visitor.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  const auto words = player::ParseOsc(std::as_bytes(std::span(data, size)));
  if (!words.ok()) {
    return 0;
  }
  drama::Visitor visitor;
  for (const std::string& word : *words) {
    CHECK(drama::ParseMessage(word).has_value());
    drama::AddKey(word, visitor.keys);
  }
  drama::VisitorLog log;
  log.Set(1, visitor);
  const auto again = drama::VisitorLog::Read(log.Write(), "again");
  CHECK(again.ok());
  CHECK(again->At(1).keys == visitor.keys);
  return 0;
}
