#include "editor/bake/line_table.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "editor/text/foreign_text.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "shared/core/lower_case.h"
#include "shared/core/plain_text.h"
#include "shared/stage/caption_file.h"

namespace lararium::bake {
namespace {

constexpr size_t kMaxTableBytes = size_t{16} << 20;
constexpr size_t kMaxLines = 4096;
constexpr size_t kMaxLanguages = 64;
constexpr size_t kMaxCell = 4000;  // Bytes.

bool IsLineId(std::string_view id) {
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

std::string Trimmed(std::string_view text) { return std::string(editor::TrimBlanks(text)); }

// "pt_BR" is "pt-BR", as in names of locales.
std::string LanguageTag(std::string text) {
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

// Checks what both formats require: valid ids, languages and texts, and unique ids.
class TableBuilder {
 public:
  Status AddLanguage(const std::string& language, const std::string& where) {
    if (!stage::IsLanguageTag(language)) {
      return Status::Error(where, "'" + language + "' is not a valid language tag",
                           "use one like la, it, en or pt-BR");
    }
    const auto& known = table_.languages;
    if (std::find(known.begin(), known.end(), language) != known.end()) {
      return Status::Error(where, "the language '" + language + "' occurs twice");
    }
    if (known.size() >= kMaxLanguages) {
      return Status::Error(where, "there are more than 64 languages");
    }
    table_.languages.push_back(language);
    return Status();
  }

  Status AddLine(Line line, const std::string& where) {
    if (!IsLineId(line.id)) {
      return Status::Error(where, "'" + line.id + "' cannot be a line's id",
                           "use 1 to 64 letters, digits, '_' and '-'");
    }
    if (line.speaker.size() > 64) {
      return Status::Error(where, "the speaker's name is longer than 64 bytes");
    }
    if (!ids_.insert(line.id).second) {
      return Status::Error(where, "the id '" + line.id + "' occurs twice", "rename one");
    }
    if (table_.lines.size() >= kMaxLines) {
      return Status::Error(where, "there are more than 4096 lines");
    }
    for (auto& [language, text] : line.text) {
      text = WithUnixLineEnds(std::move(text));
    }
    line.notes = WithUnixLineEnds(std::move(line.notes));
    std::erase_if(line.text, [](const auto& entry) { return Trimmed(entry.second).empty(); });
    table_.lines.push_back(std::move(line));
    return Status();
  }

  const LineTable& table() const { return table_; }
  LineTable Take() { return std::move(table_); }

 private:
  LineTable table_;
  std::set<std::string> ids_;
};

Result<editor::ForeignText> Decode(std::string_view text,
                                   const std::string& where,
                                   const std::string& declared = "") {
  if (text.size() > kMaxTableBytes) {
    return Status::Error(where, "is longer than 16 MiB");
  }
  return editor::DecodeText(text, where, declared);
}

// ---- CSV ----

// Reads rows of cells from a text.
class CsvReader {
 public:
  CsvReader(std::string_view text, std::string where) : text_(text), place_(std::move(where)) {
    // Spreadsheets name the separator in a row before the header, such as "sep=;".
    const std::string_view head = text_.substr(0, text_.find('\n'));
    const std::string_view named = head.substr(0, 1) == "\"" ? head.substr(1) : head;
    if (named.starts_with("sep=") && named.size() > 4) {
      separator_ = named[4];
      at_ = std::min(head.size() + 1, text_.size());
      ++next_row_;
      ++next_line_;
    } else {
      separator_ = GuessSeparator(text_);
    }
  }

  bool AtEnd() const { return at_ >= text_.size(); }
  // Names the begin of the row that was read last.
  std::string Where() const {
    return place_ + ": row " + std::to_string(row_) +
           (line_ == row_ ? "" : " (line " + std::to_string(line_) + ")");
  }

  // Reads a row. A row with an error ends at the end of its first line.
  Status Next(std::vector<std::string>& cells) {
    const size_t begin = at_;
    row_ = next_row_++;
    line_ = next_line_;
    const Status status = ReadRow(cells);
    if (!status.ok()) {
      at_ = std::min(text_.find('\n', begin), text_.size());
    }
    Take('\n');
    next_line_ += static_cast<int>(std::count(text_.begin() + static_cast<ptrdiff_t>(begin),
                                              text_.begin() + static_cast<ptrdiff_t>(at_), '\n'));
    return status;
  }

 private:
  // The separator that occurs most often in the first line.
  static char GuessSeparator(std::string_view text) {
    const std::string_view head = text.substr(0, text.find('\n'));
    char best = ',';
    for (const char candidate : {';', '\t', '|'}) {
      if (std::count(head.begin(), head.end(), candidate) >
          std::count(head.begin(), head.end(), best)) {
        best = candidate;
      }
    }
    return best;
  }

  bool Take(char c) {
    const bool there = !AtEnd() && text_[at_] == c;
    at_ += there ? 1 : 0;
    return there;
  }

  Status ReadRow(std::vector<std::string>& cells) {
    cells.clear();
    do {
      LARARIUM_RETURN_IF_ERROR(ReadCell(cells.emplace_back()));
    } while (Take(separator_));
    return Status();
  }

  Status ReadCell(std::string& cell) {
    // Blanks may stand before a quote.
    const size_t first = text_.find_first_not_of(' ', at_);
    if (first != std::string_view::npos && text_[first] == '"') {
      at_ = first + 1;
      return ReadQuoted(cell);
    }
    return ReadPlain(cell);
  }

  Status ReadPlain(std::string& cell) {
    const char ends[] = {separator_, '\n'};
    const size_t end = std::min(text_.find_first_of(std::string_view(ends, 2), at_), text_.size());
    cell = text_.substr(at_, end - at_);
    at_ = end;
    return CheckLength(cell);
  }

  Status ReadQuoted(std::string& cell) {
    while (true) {
      const size_t quote = text_.find('"', at_);
      if (quote == std::string_view::npos) {
        return Status::Error(Where(), "a quote is not closed",
                             "close it, and write a quote within a text twice");
      }
      cell += text_.substr(at_, quote - at_);
      at_ = quote + 1;
      LARARIUM_RETURN_IF_ERROR(CheckLength(cell));
      if (!Take('"')) {
        break;
      }
      cell += '"';
    }
    at_ = std::min(text_.find_first_not_of(' ', at_), text_.size());
    if (!AtEnd() && text_[at_] != separator_ && text_[at_] != '\n') {
      return Status::Error(Where(), "there is text after a closing quote",
                           "write a quote within a text twice");
    }
    return Status();
  }

  Status CheckLength(const std::string& cell) const {
    if (cell.size() > kMaxCell) {
      return Status::Error(Where(), "a cell is longer than 4000 bytes");
    }
    return Status();
  }

  std::string_view text_;
  std::string place_;
  char separator_ = ',';
  size_t at_ = 0;
  int row_ = 1;   // Number of the row that was read last, as spreadsheets count.
  int line_ = 1;  // First line of that row; quoted cells may have several.
  int next_row_ = 1;
  int next_line_ = 1;
};

// A column that cannot be used is ignored; its header is in LinesFile::left_out.
enum class Column { kId, kSpeaker, kNotes, kText, kUnnamed, kIgnored };

struct Header {
  std::vector<Column> columns;
  std::vector<std::string> languages;  // Parallel to `columns`; "" if the column holds no text.
};

// A column that cannot be used is added to `left_out`.
Result<Header> ReadHeader(const std::vector<std::string>& cells,
                          const std::string& where,
                          TableBuilder& builder,
                          std::vector<Status>& left_out) {
  Header header;
  std::set<std::string> seen;
  for (const std::string& cell : cells) {
    const std::string name = Trimmed(cell);
    const std::string word = LowerCase(name);
    Column column = name.empty()        ? Column::kUnnamed
                    : word == "id"      ? Column::kId
                    : word == "speaker" ? Column::kSpeaker
                    : word == "notes"   ? Column::kNotes
                                        : Column::kText;
    const std::string language = column == Column::kText ? LanguageTag(name) : "";
    Status status;
    if (column == Column::kText) {
      status = builder.AddLanguage(language, where);
    } else if (column != Column::kUnnamed && !seen.insert(word).second) {
      status = Status::Error(where, "the column '" + word + "' occurs twice");
    }
    if (!status.ok()) {
      left_out.push_back(std::move(status));
      column = Column::kIgnored;
    }
    header.columns.push_back(column);
    header.languages.push_back(column == Column::kText ? language : "");
  }
  if (!seen.contains("id")) {
    return Status::Error(where, "there is no column 'id'",
                         "begin with a row: id,speaker,notes,la,en");
  }
  return header;
}

Line ReadLine(std::vector<std::string>& cells, const Header& header) {
  Line line;
  for (size_t i = 0; i < header.columns.size() && i < cells.size(); ++i) {
    switch (header.columns[i]) {
      case Column::kId:
        line.id = Trimmed(cells[i]);
        break;
      case Column::kSpeaker:
        line.speaker = Trimmed(cells[i]);
        break;
      case Column::kNotes:
        line.notes = std::move(cells[i]);
        break;
      case Column::kText:
        line.text[header.languages[i]] = std::move(cells[i]);
        break;
      case Column::kUnnamed:
      case Column::kIgnored:
        break;
    }
  }
  return line;
}

std::string CsvCell(const std::string& text) {
  if (text.find_first_of(",;\t\"\r\n") == std::string::npos) {
    return text;
  }
  std::string cell = "\"";
  for (const char c : text) {
    cell += c == '"' ? "\"\"" : std::string(1, c);
  }
  return cell + "\"";
}

const std::string& TextOf(const Line& line, const std::string& language) {
  static const std::string kNone;
  const auto found = line.text.find(language);
  return found == line.text.end() ? kNone : found->second;
}

// ---- PO ----

// Decodes the quoted strings after a keyword or on a line of their own.
std::optional<std::string> Unquote(std::string_view text) {
  std::string plain;
  bool inside = false;
  bool any = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      inside = !inside;
      any = true;
    } else if (!inside) {
      if (c != ' ' && c != '\t') {
        return std::nullopt;
      }
    } else if (c != '\\') {
      plain += c;
    } else if (++i < text.size()) {
      plain += text[i] == 'n' ? '\n' : text[i] == 't' ? '\t' : text[i] == 'r' ? '\r' : text[i];
    }
  }
  return any && !inside ? std::optional(std::move(plain)) : std::nullopt;
}

// The value of a field in the header, such as "Language"; empty if there is none.
std::string HeaderField(std::string_view header, std::string_view field) {
  const size_t at = header.find(field);
  if (at == std::string_view::npos) {
    return "";
  }
  const size_t begin = at + field.size();
  return Trimmed(header.substr(begin, header.find_first_of("\n\\", begin) - begin));
}

class PoReader {
 public:
  void ReadRow(std::string_view row) {
    ++row_;
    row = editor::TrimBlanks(row);
    if (row.starts_with("#,")) {
      StartEntry();
      entry_.fuzzy = entry_.fuzzy || row.find("fuzzy") != std::string_view::npos;
    } else if (row.starts_with("#~")) {
      // An obsolete entry; the comments before it are its own.
      if (target_ == nullptr) {
        entry_ = {};
      }
    } else if (row.empty()) {
      damaged_ = false;
    } else if (row.front() == '"') {
      Append(row);
    } else if (row.front() != '#') {
      ReadKeyword(row);
    }
  }

  // Fails if no entry could be read.
  Result<PoFile> Take(const std::string& where) {
    Finish();
    if (file_.entries.empty() && file_.language.empty() && !file_.notes.empty()) {
      return Status::Error(where, file_.notes.front());
    }
    return std::move(file_);
  }

 private:
  // Drops the entry with this row, up to the next one.
  void Problem(std::string_view what) {
    if (!damaged_) {
      file_.notes.push_back("line " + std::to_string(row_) + ": " + std::string(what) +
                            "; the entry was left out");
    }
    entry_ = {};
    has_text_ = false;
    target_ = nullptr;
    damaged_ = true;
  }

  // A new entry begins after a translation.
  void StartEntry() {
    if (has_text_) {
      Finish();
    }
    if (entry_.row == 0) {
      entry_.row = row_;
    }
  }

  void ReadKeyword(std::string_view row) {
    const std::string_view keyword = row.substr(0, row.find_first_of(" \t\""));
    const bool begins = keyword == "msgctxt" || keyword == "msgid";
    damaged_ = damaged_ && !begins;
    if (damaged_) {
      return;
    }
    if (keyword == "msgctxt" || (keyword == "msgid" && has_text_)) {
      StartEntry();
    }
    if (entry_.row == 0) {
      entry_.row = row_;
    }
    if (keyword == "msgctxt") {
      target_ = &entry_.context;
    } else if (keyword == "msgid") {
      target_ = &entry_.source;
    } else if (keyword == "msgstr" || keyword == "msgstr[0]") {
      target_ = &entry_.text;
      has_text_ = true;
    } else if (keyword == "msgid_plural") {
      file_.notes.push_back("line " + std::to_string(row_) +
                            ": of several plural forms the first is taken");
      target_ = &ignored_;
    } else if (keyword.starts_with("msgstr[") || keyword == "domain") {
      target_ = &ignored_;
    } else {
      if (has_text_) {
        Finish();
      }
      return Problem("'" + std::string(keyword.substr(0, 40)) + "' is no word of a PO file");
    }
    target_->clear();
    Append(row.substr(keyword.size()));
  }

  void Append(std::string_view quoted) {
    if (damaged_) {
      return;
    }
    const std::optional<std::string> text = Unquote(quoted);
    if (!text) {
      return Problem("a quoted text was expected");
    }
    if (target_ == nullptr) {
      return Problem("a text stands before any msgid");
    }
    if (target_->size() + text->size() > 16 * kMaxCell) {
      return Problem("a text is too long");
    }
    *target_ += *text;
  }

  void Finish() {
    if (has_text_ && entry_.source.empty() && entry_.context.empty()) {
      // Names of locales go on, as in "it_IT.UTF-8".
      std::string language = LanguageTag(HeaderField(entry_.text, "Language:"));
      language.resize(std::min(language.find_first_of(".@"), language.size()));
      file_.language = stage::IsLanguageTag(language) ? language : "";
    } else if (has_text_) {
      file_.entries.push_back(std::move(entry_));
    }
    entry_ = {};
    has_text_ = false;
    target_ = nullptr;
  }

  int row_ = 0;
  PoFile file_;
  PoEntry entry_;
  bool has_text_ = false;
  bool damaged_ = false;  // Rows are skipped up to the next entry.
  std::string* target_ = nullptr;
  std::string ignored_;
};

Result<LineTable> WholeTable(Result<LinesFile> file) {
  if (!file.ok()) {
    return file.status();
  }
  return file->left_out.empty() ? Result<LineTable>(std::move(file->table))
                                : Result<LineTable>(file->left_out.front());
}

}  // namespace

const Line* LineTable::Find(std::string_view id) const {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [id](const Line& line) { return line.id == id; });
  return found == lines.end() ? nullptr : &*found;
}

Result<LinesFile> ReadLinesCsv(std::string_view text, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const editor::ForeignText decoded, Decode(text, where));
  LinesFile file;
  TableBuilder builder;
  CsvReader reader(decoded.text, where);
  std::vector<std::string> cells;
  LARARIUM_RETURN_IF_ERROR(reader.Next(cells));
  LARARIUM_ASSIGN_OR_RETURN(const Header header,
                            ReadHeader(cells, reader.Where(), builder, file.left_out));
  const auto is_blank = [](const std::string& cell) { return Trimmed(cell).empty(); };
  while (!reader.AtEnd()) {
    Status status = reader.Next(cells);
    if (status.ok() && std::all_of(cells.begin(), cells.end(), is_blank)) {
      continue;
    }
    const size_t known = std::min(cells.size(), header.columns.size());
    if (status.ok() &&
        !std::all_of(cells.begin() + static_cast<ptrdiff_t>(known), cells.end(), is_blank)) {
      status = Status::Error(reader.Where(), "has more cells than the header row",
                             "put texts that hold the separator into quotes");
    }
    for (size_t i = 0; status.ok() && i < known; ++i) {
      if (header.columns[i] == Column::kUnnamed && !is_blank(cells[i])) {
        file.left_out.push_back(Status::Error(reader.Where(),
                                              "holds a text in a column that has no name",
                                              "name the column in the header row"));
      }
    }
    if (status.ok()) {
      status = builder.AddLine(ReadLine(cells, header), reader.Where());
    }
    if (!status.ok()) {
      file.left_out.push_back(std::move(status));
    }
  }
  file.table = builder.Take();
  file.note = decoded.note.empty() ? "" : where + ": " + decoded.note;
  return file;
}

Result<LineTable> ParseLinesCsv(std::string_view text, const std::string& where) {
  return WholeTable(ReadLinesCsv(text, where));
}

std::string FormatLinesCsv(const LineTable& table) {
  std::string csv = "id,speaker,notes";
  for (const std::string& language : table.languages) {
    csv += "," + language;
  }
  csv += "\n";
  for (const Line& line : table.lines) {
    csv += line.id + "," + CsvCell(line.speaker) + "," + CsvCell(line.notes);
    for (const std::string& language : table.languages) {
      csv += "," + CsvCell(TextOf(line, language));
    }
    csv += "\n";
  }
  return csv;
}

namespace {

void DescribeLine(Fields& fields, const std::vector<std::string>& languages, Line& line) {
  fields.Text("id", line.id, 64);
  fields.Text(Optional("speaker", !line.speaker.empty()), line.speaker, 64);
  fields.Text(Optional("notes", !line.notes.empty()), line.notes, kMaxCell);
  fields.Entries("text", line.text, std::numeric_limits<size_t>::max(), "must be an object",
                 [&](const FieldKey& language, std::string& text) {
                   const std::string name(language.name);
                   fields.Require(
                       std::find(languages.begin(), languages.end(), name) != languages.end(),
                       "'" + name + "' is none of the file's \"languages\"");
                   fields.Text(language, text, kMaxCell);
                 });
}

// While reading, `builder` checks the languages and the lines, and keeps them.
void DescribeTable(Fields& fields, LineTable& table, TableBuilder& builder) {
  fields.Schema(1);
  fields.List("languages", table.languages, kMaxLanguages,
              [&](const FieldKey& key, std::string& tag) {
                fields.Text(key, tag, 64);
                if (fields.reading()) {
                  fields.Check(builder.AddLanguage(tag, fields.where(key)));
                }
              });
  fields.List("lines", table.lines, kMaxLines, [&](Fields& entry, Line& line) {
    DescribeLine(entry, table.languages, line);
    if (entry.reading()) {
      entry.Check(builder.AddLine(line, entry.where()));
    }
  });
}

}  // namespace

Result<LinesFile> ReadLinesJson(std::string_view text, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const editor::ForeignText decoded, Decode(text, where));
  LineTable table;
  TableBuilder builder;
  LARARIUM_RETURN_IF_ERROR(ReadFields(
      decoded.text, where, [&](Fields& fields) { DescribeTable(fields, table, builder); }));
  return LinesFile{builder.Take(), decoded.note.empty() ? "" : where + ": " + decoded.note, {}};
}

std::string FormatLinesJson(const LineTable& table) {
  LineTable written = table;
  TableBuilder unused;
  const Json json = WriteFields([&](Fields& fields) { DescribeTable(fields, written, unused); });
  return json.dump(1) + "\n";
}

Result<PoFile> ParsePo(std::string_view text, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const editor::ForeignText decoded,
                            Decode(text, where, HeaderField(text.substr(0, 4096), "charset=")));
  PoReader reader;
  for (std::string_view rest = decoded.text; !rest.empty();) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    reader.ReadRow(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  LARARIUM_ASSIGN_OR_RETURN(PoFile file, reader.Take(where));
  if (!decoded.note.empty()) {
    file.notes.insert(file.notes.begin(), decoded.note);
  }
  return file;
}

PoImport ImportPo(const PoFile& po, const std::string& language, LineTable& table) {
  PoImport report;
  if (std::find(table.languages.begin(), table.languages.end(), language) ==
      table.languages.end()) {
    table.languages.push_back(language);
  }
  for (const PoEntry& entry : po.entries) {
    const auto is_meant = [&](const Line& line) {
      return entry.context.empty()
                 ? std::any_of(line.text.begin(), line.text.end(),
                               [&](const auto& text) { return text.second == entry.source; })
                 : line.id == entry.context;
    };
    report.fuzzy += entry.fuzzy ? 1 : 0;
    int meant = 0;
    for (Line& line : table.lines) {
      if (is_meant(line)) {
        ++meant;
        if (!entry.fuzzy && !entry.text.empty()) {
          line.text[language] = entry.text;
          ++report.translated;
        }
      }
    }
    if (meant == 0) {
      report.unknown.push_back("line " + std::to_string(entry.row) + ": " +
                               (entry.context.empty() ? entry.source : entry.context));
    }
  }
  return report;
}

Result<LinesFile> ReadLines(const std::filesystem::path& folder) {
  const std::filesystem::path csv = folder / "lines.csv";
  const std::filesystem::path json = folder / "lines.json";
  const bool has_csv = FileExists(csv);
  const bool has_json = FileExists(json);
  if (has_csv && has_json) {
    return Status::Error(json.string(), "lines.csv exists too", "keep one of them");
  }
  if (!has_csv && !has_json) {
    return LinesFile();
  }
  const std::filesystem::path& file = has_csv ? csv : json;
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxTableBytes));
  return has_csv ? ReadLinesCsv(text, file.string()) : ReadLinesJson(text, file.string());
}

Result<LineTable> LoadLines(const std::filesystem::path& folder) {
  return WholeTable(ReadLines(folder));
}

Status SaveLines(const std::filesystem::path& folder, const LineTable& table) {
  LARARIUM_RETURN_IF_ERROR(ParseLinesCsv(FormatLinesCsv(table), folder.string()).status());
  if (const Status before = LoadLines(folder).status(); !before.ok()) {
    return Status::Error(before.message(), "the lines are not saved, because that would be lost",
                         "correct or remove the file first");
  }
  const std::filesystem::path json = folder / "lines.json";
  if (FileExists(json)) {
    return WriteFileAtomically(json, FormatLinesJson(table));
  }
  return WriteFileAtomically(folder / "lines.csv", FormatLinesCsv(table));
}

}  // namespace lararium::bake
