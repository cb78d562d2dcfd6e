#include "editor/document/line_edits.h"

#include <algorithm>
#include <utility>

namespace lararium::editor {

namespace {

bake::Line& LineOf(bake::LineTable& table, const std::string& id, const std::string& speaker) {
  const auto found = std::find_if(table.lines.begin(), table.lines.end(),
                                  [&](const bake::Line& line) { return line.id == id; });
  if (found != table.lines.end()) {
    return *found;
  }
  table.lines.push_back({.id = id, .speaker = speaker, .notes = {}, .text = {}});
  return table.lines.back();
}

}  // namespace

bake::LineTable WithText(bake::LineTable table,
                         const std::string& id,
                         const std::string& speaker,
                         const std::string& language,
                         const std::string& text) {
  table = WithLanguage(std::move(table), language);
  bake::Line& line = LineOf(table, id, speaker);
  if (text.empty()) {
    line.text.erase(language);
  } else {
    line.text[language] = text;
  }
  return table;
}

bake::LineTable WithLine(bake::LineTable table, const std::string& id, const std::string& speaker) {
  LineOf(table, id, speaker);
  return table;
}

bake::LineTable WithLanguage(bake::LineTable table, const std::string& language) {
  if (std::find(table.languages.begin(), table.languages.end(), language) ==
      table.languages.end()) {
    table.languages.push_back(language);
  }
  return table;
}

std::string FreeLineId(const bake::LineTable& table, const std::string& stem) {
  for (int number = 1;; ++number) {
    std::string id = stem + std::to_string(number);
    if (table.Find(id) == nullptr) {
      return id;
    }
  }
}

}  // namespace lararium::editor
