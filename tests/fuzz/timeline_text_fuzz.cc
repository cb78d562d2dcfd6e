// libFuzzer harness: any text as a drama whose timeline is read and edited. A timeline that was
// read can be edited, and the edited text can be read.

#include <string>

#include "shared/drama/timeline_text.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  using namespace lararium::drama;
  const std::string text(reinterpret_cast<const char*>(data), size);
  auto timeline = TimelineText::Read(text, "fuzz.lua");
  if (!timeline.ok()) {
    return 0;
  }
  CHECK(timeline->text() == text);
  for (size_t lane = 0; lane < timeline->lanes().size(); ++lane) {
    const size_t items = timeline->lanes()[lane].size();
    CHECK(timeline->Insert(lane, {{"at", 1}, {"name", "fuzz"}}).ok());
    CHECK(timeline->lanes()[lane].size() == items + 1);
    CHECK(timeline->Set({lane, 0}, "at", 2.5).ok());
    CHECK(timeline->Set({lane, items / 2}, "length", 0.25).ok());
    CHECK(timeline->Unset({lane, items / 2}, "length").ok());
    std::vector<uint32_t> found;
    timeline->Query(lane, 0.0, 3.0, found);
    CHECK(TimelineText::Read(timeline->text(), "fuzz.lua").ok());
    CHECK(timeline->Remove({lane, 0}).ok());
    CHECK(timeline->lanes()[lane].size() == items);
  }
  return 0;
}
