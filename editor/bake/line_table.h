#pragma once

// The lines of a project: what is said and read, in all languages. One id stands for a
// line's text, voice, visemes and captions in each of them.
//
// lines.csv has a header: id, speaker, notes, and a language tag for each further column
// (la, it, en). A row without a speaker whose id is an actor's name says how captions call
// that actor. A row whose speaker is "description" is a description for visitors who do not see
// well, unless an actor is called so.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct Line {
  std::string id;       // letters, digits, '_' and '-', at most 64: it names files too
  std::string speaker;  // of the cast; empty: nobody
  std::string notes;    // for speakers and translators
  std::map<std::string, std::string, std::less<>> text;  // by language, UTF-8, never empty

  friend bool operator==(const Line&, const Line&) = default;
};

struct LineTable {
  std::vector<std::string> languages;  // in the order of the columns
  std::vector<Line> lines;             // ids are unique

  const Line* Find(std::string_view id) const;

  friend bool operator==(const LineTable&, const LineTable&) = default;
};

// CSV as spreadsheets write it (RFC 4180): UTF-8 with or without a mark, ',', ';' or tab
// between cells, quotes around cells that hold any of them or ends of lines.
// place: what errors call the text; they name row and column.
Result<LineTable> ParseLinesCsv(std::string_view text, const std::string& place);
std::string FormatLinesCsv(const LineTable& table);

// {"schema": 1, "languages": ["la"], "lines": [{"id", "speaker", "notes", "text": {"la": ""}}]}
Result<LineTable> ParseLinesJson(std::string_view text, const std::string& place);
std::string FormatLinesJson(const LineTable& table);

// A gettext catalogue of one language.
struct PoEntry {
  int row = 0;          // where it begins
  std::string context;  // msgctxt
  std::string source;   // msgid
  std::string text;     // msgstr; empty: not translated
  bool fuzzy = false;   // the translator is not sure
};
struct PoFile {
  std::string language;  // of the header; empty: it does not say
  std::vector<PoEntry> entries;
};
Result<PoFile> ParsePo(std::string_view text, const std::string& place);

// Takes over what was translated: an entry means the line whose id is its context, else all
// whose text in any language is its source. Fuzzy ones are left out. Gives how many texts
// were set, and the entries that mean no line.
struct PoImport {
  int translated = 0;
  std::vector<std::string> unknown;
};
PoImport ImportPo(const PoFile& po, const std::string& language, LineTable& table);

// lines.csv or lines.json of a project's folder; empty where there is neither. Both are an
// error: nobody could say which is meant.
Result<LineTable> LoadLines(const std::filesystem::path& folder);
// Into the file that is there; else lines.csv. A table that could not be read back is refused.
Status SaveLines(const std::filesystem::path& folder, const LineTable& table);

}  // namespace lararium::bake
