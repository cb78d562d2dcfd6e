// libFuzzer harness: importing any text as BML terminates, and the resulting items lie within the
// drama's time.

#include <cmath>
#include <string_view>

#include "editor/import/motion/bml.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  import::BmlStage stage;
  stage.characters = {{"", "keeper"}, {"Alice", "girl"}};
  stage.clips["keeper"]["wave"] = drama::PlainTimes(2.0);
  stage.lines["salvete"] = {{"Hello"}, drama::PlainTimes(1.0)};
  stage.objects["counter"] = {1.0, 2.0};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto imported = import::ImportBml(text, "fuzz.xml", stage);
  if (imported.ok()) {
    for (const import::BmlItem& item : imported->items) {
      const double at = item.fields["at"];
      CHECK(std::isfinite(at) && at >= 0.0);
    }
  }
  return 0;
}
