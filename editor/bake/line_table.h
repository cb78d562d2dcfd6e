#pragma once

// The lines of a project: all text that is spoken or read, in all languages. One id names the
// text, voice, visemes and captions of a line in each language.
//
// lines.csv has a header: id, speaker, notes, then one column for each language tag (la, it,
// en). A row without a speaker whose id is the name of an actor gives the name of that actor in
// captions. A row whose speaker is "description" is an audio description for visitors with low
// vision, unless an actor has that name.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct Line {
  std::string id;       // Letters, digits, '_' and '-', at most 64, because it names files.
  std::string speaker;  // Name of an actor in the cast; empty if there is no speaker.
  std::string notes;    // Remarks for speakers and translators.
  // Text by language tag, UTF-8, never empty.
  std::map<std::string, std::string, std::less<>> text;

  friend bool operator==(const Line&, const Line&) = default;
};

struct LineTable {
  std::vector<std::string> languages;  // Language tags in the order of the columns.
  std::vector<Line> lines;             // ids are unique

  const Line* Find(std::string_view id) const;

  friend bool operator==(const LineTable&, const LineTable&) = default;
};

// A table as it was read from a file in which something may be wrong.
struct LinesFile {
  LineTable table;
  std::string note;              // Names an encoding that was guessed; usually empty.
  std::vector<Status> left_out;  // Rows and columns that could not be read.
};

// CSV as spreadsheets write it (RFC 4180), in any encoding (editor/text/foreign_text.h): ',', ';',
// '|' or tab between cells, also named by a first row "sep=;"; quotes around cells that contain one
// of these or a line break. A bad row costs that row. Parse… fails instead if anything would be
// left out. Errors name the text as `where`, and the row.
Result<LinesFile> ReadLinesCsv(std::string_view text, const std::string& where);
Result<LineTable> ParseLinesCsv(std::string_view text, const std::string& where);
std::string FormatLinesCsv(const LineTable& table);

// {"schema": 1, "languages": ["la"], "lines": [{"id", "speaker", "notes", "text": {"la": ""}}]}
Result<LinesFile> ReadLinesJson(std::string_view text, const std::string& where);
std::string FormatLinesJson(const LineTable& table);

// One translated text in a gettext catalogue of one language.
struct PoEntry {
  int row = 0;          // Line of the file at which the entry begins.
  std::string context;  // msgctxt
  std::string source;   // msgid
  std::string text;     // msgstr; empty if not translated.
  bool fuzzy = false;   // The translator marked the text as uncertain.
};
struct PoFile {
  std::string language;  // Language in the header; empty if the header does not state it.
  std::vector<PoEntry> entries;
  std::vector<std::string> notes;  // Lists what was left out or guessed: "line 12: ...".
};
// Reads the encoding that the header declares, or any other. A bad entry costs that entry.
Result<PoFile> ParsePo(std::string_view text, const std::string& where);

// Copies translations into the table. An entry belongs to the line whose id is its context;
// without one, to all lines whose text in any language equals its source. Skips fuzzy entries.
// Reports how many texts were set and which entries match no line.
struct PoImport {
  int translated = 0;
  int fuzzy = 0;  // Number of entries that were skipped.
  std::vector<std::string> unknown;
};
PoImport ImportPo(const PoFile& po, const std::string& language, LineTable& table);

// Reads lines.csv or lines.json in the folder of a project; the table is empty if there is
// neither. Having both is an error, because it would not be clear which one counts. LoadLines() is
// for edits: it fails if anything would be left out, because saving would lose that.
Result<LinesFile> ReadLines(const std::filesystem::path& folder);
Result<LineTable> LoadLines(const std::filesystem::path& folder);
// Writes the file that exists, otherwise lines.csv. Refuses a table that could not be read
// back, and to replace a file that LoadLines() cannot read.
Status SaveLines(const std::filesystem::path& folder, const LineTable& table);

}  // namespace lararium::bake
