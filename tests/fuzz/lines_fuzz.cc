// libFuzzer harness: reading any text as a table of lines or as a catalogue terminates, and an
// accepted table is unchanged after writing and reading it.

#include <string_view>

#include "editor/bake/line_table.h"
#include "shared/core/check.h"

using namespace lararium;  // NOLINT(google-build-using-namespace)

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  auto file = bake::ReadLinesCsv(text, "lines.csv");
  if (file.ok()) {
    const bake::LineTable* table = &file->table;
    const auto csv = bake::ParseLinesCsv(bake::FormatLinesCsv(*table), "again.csv");
    CHECK(csv.ok() && *csv == *table);
    const auto json = bake::ReadLinesJson(bake::FormatLinesJson(*table), "again.json");
    CHECK(json.ok() && json->table == *table);
  }
  (void)bake::ReadLinesJson(text, "lines.json").ok();
  const auto po = bake::ParsePo(text, "it.po");
  if (po.ok()) {
    bake::LineTable lines;
    lines.lines = {{"salvete", "keeper", "", {{"la", "Salve"}}}};
    bake::ImportPo(*po, "it", lines);
  }
  return 0;
}
