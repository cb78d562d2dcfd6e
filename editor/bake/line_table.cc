#include "editor/bake/line_table.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "shared/core/byte_order_mark.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"
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

// Accepts shortest forms only, no surrogates, nothing above U+10FFFF (Unicode 15, table 3-7).
bool IsUtf8(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const int more = lead < 0x80 ? 0 : lead < 0xC2 ? -1 : lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    if (more < 0 || lead > 0xF4) {
      return false;
    }
    unsigned char least = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    unsigned char most = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    for (int k = 0; k < more; ++k, least = 0x80, most = 0xBF) {
      const auto next = i < text.size() ? static_cast<unsigned char>(text[i++]) : 0;
      if (next < least || next > most) {
        return false;
      }
    }
  }
  return true;
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
    std::erase_if(line.text, [](const auto& entry) { return entry.second.empty(); });
    table_.lines.push_back(std::move(line));
    return Status();
  }

  const LineTable& table() const { return table_; }
  LineTable Take() { return std::move(table_); }

 private:
  LineTable table_;
  std::set<std::string> ids_;
};

Status CheckText(std::string_view text, const std::string& where) {
  if (text.size() > kMaxTableBytes) {
    return Status::Error(where, "is longer than 16 MiB");
  }
  if (!IsUtf8(text)) {
    return Status::Error(where, "is not UTF-8", "save it as UTF-8");
  }
  if (text.find('\0') != std::string_view::npos) {
    return Status::Error(where, "holds a zero byte");
  }
  return Status();
}

// ---- CSV ----

// Reads rows of cells from a text.
class CsvReader {
 public:
  CsvReader(std::string_view text, std::string where)
      : text_(WithoutByteOrderMark(text)),
        place_(std::move(where)),
        separator_(GuessSeparator(text_)) {}

  bool AtEnd() const { return at_ >= text_.size(); }
  // Names the begin of the row that was read last.
  std::string Where() const { return place_ + ": row " + std::to_string(row_); }

  Status Next(std::vector<std::string>& cells) {
    cells.clear();
    row_ = next_row_;
    do {
      LARARIUM_RETURN_IF_ERROR(ReadCell(cells.emplace_back()));
    } while (Take(separator_));
    Take('\r');
    Take('\n');
    ++next_row_;
    return Status();
  }

 private:
  // The separator that occurs most often in the first line.
  static char GuessSeparator(std::string_view text) {
    const std::string_view head = text.substr(0, text.find('\n'));
    char best = ',';
    for (const char candidate : {';', '\t'}) {
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

  Status ReadCell(std::string& cell) { return Take('"') ? ReadQuoted(cell) : ReadPlain(cell); }

  Status ReadPlain(std::string& cell) {
    const char ends[] = {separator_, '\r', '\n', '\0'};
    const size_t end = std::min(text_.find_first_of(std::string_view(ends, 3), at_), text_.size());
    cell = text_.substr(at_, end - at_);
    at_ = end;
    return CheckLength(cell);
  }

  Status ReadQuoted(std::string& cell) {
    while (true) {
      const size_t quote = text_.find('"', at_);
      if (quote == std::string_view::npos) {
        return Status::Error(Where(), "a quote is not closed");
      }
      cell += text_.substr(at_, quote - at_);
      at_ = quote + 1;
      LARARIUM_RETURN_IF_ERROR(CheckLength(cell));
      if (!Take('"')) {
        break;
      }
      cell += '"';
    }
    if (!AtEnd() && text_[at_] != separator_ && text_[at_] != '\r' && text_[at_] != '\n') {
      return Status::Error(Where(), "there is text after a closing quote");
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
  char separator_;
  size_t at_ = 0;
  int row_ = 1;
  int next_row_ = 1;
};

enum class Column { kId, kSpeaker, kNotes, kText };

struct Header {
  std::vector<Column> columns;
  std::vector<std::string> languages;  // Parallel to `columns`; "" if the column holds no text.
};

Result<Header> ReadHeader(const std::vector<std::string>& cells,
                          const std::string& where,
                          TableBuilder& builder) {
  Header header;
  std::set<std::string> seen;
  for (const std::string& cell : cells) {
    const Column column = cell == "id"        ? Column::kId
                          : cell == "speaker" ? Column::kSpeaker
                          : cell == "notes"   ? Column::kNotes
                                              : Column::kText;
    if (column == Column::kText) {
      LARARIUM_RETURN_IF_ERROR(builder.AddLanguage(cell, where));
    } else if (!seen.insert(cell).second) {
      return Status::Error(where, "the column '" + cell + "' occurs twice");
    }
    header.columns.push_back(column);
    header.languages.push_back(column == Column::kText ? cell : "");
  }
  if (!seen.contains("id")) {
    return Status::Error(where, "there is no column 'id'",
                         "begin with a row: id,speaker,notes,la,en");
  }
  return header;
}

Line ReadLine(std::vector<std::string>& cells, const Header& header) {
  Line line;
  for (size_t i = 0; i < cells.size(); ++i) {
    switch (header.columns[i]) {
      case Column::kId:
        line.id = std::move(cells[i]);
        break;
      case Column::kSpeaker:
        line.speaker = std::move(cells[i]);
        break;
      case Column::kNotes:
        line.notes = std::move(cells[i]);
        break;
      case Column::kText:
        line.text[header.languages[i]] = std::move(cells[i]);
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

// Decodes a quoted string after a keyword or on a line of its own.
std::optional<std::string> Unquote(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') {
    return std::nullopt;
  }
  text = text.substr(1, text.size() - 2);
  std::string plain;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      return std::nullopt;
    }
    if (text[i] != '\\') {
      plain += text[i];
      continue;
    }
    if (++i == text.size()) {
      return std::nullopt;
    }
    plain += text[i] == 'n' ? '\n' : text[i] == 't' ? '\t' : text[i] == 'r' ? '\r' : text[i];
  }
  return plain;
}

class PoReader {
 public:
  explicit PoReader(std::string where) : place_(std::move(where)) {}

  Status ReadRow(std::string_view row) {
    ++row_;
    row = Trim(row);
    if (row.starts_with("#,")) {
      StartEntry();
      entry_.fuzzy = entry_.fuzzy || row.find("fuzzy") != std::string_view::npos;
      return Status();
    }
    if (row.empty() || row.front() == '#') {
      return Status();  // "#~" marks obsolete entries.
    }
    if (row.front() == '"') {
      return Append(row);
    }
    return ReadKeyword(row);
  }

  Result<PoFile> Take() {
    Finish();
    return std::move(file_);
  }

 private:
  static std::string_view Trim(std::string_view text) {
    const size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) {
      return {};
    }
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
  }

  Status Problem(std::string_view what) const {
    return Status::Error(place_ + ": line " + std::to_string(row_), what);
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

  Status ReadKeyword(std::string_view row) {
    const std::string_view keyword = row.substr(0, row.find_first_of(" \t"));
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
    } else if (keyword == "msgid_plural" || keyword.starts_with("msgstr[")) {
      target_ = &ignored_;
    } else {
      return Problem("'" + std::string(keyword.substr(0, 40)) + "' is no word of a PO file");
    }
    target_->clear();
    return Append(Trim(row.substr(keyword.size())));
  }

  Status Append(std::string_view quoted) {
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
    return Status();
  }

  void Finish() {
    if (has_text_ && entry_.source.empty() && entry_.context.empty()) {
      ReadHeader(entry_.text);
    } else if (has_text_) {
      file_.entries.push_back(std::move(entry_));
    }
    entry_ = {};
    has_text_ = false;
    target_ = nullptr;
  }

  void ReadHeader(const std::string& header) {
    constexpr std::string_view kField = "Language:";
    const size_t at = header.find(kField);
    if (at != std::string::npos) {
      const size_t begin = at + kField.size();
      std::string language(Trim(header.substr(begin, header.find('\n', begin) - begin)));
      std::replace(language.begin(), language.end(), '_', '-');
      if (stage::IsLanguageTag(language)) {
        file_.language = language;
      }
    }
  }

  std::string place_;
  int row_ = 0;
  PoFile file_;
  PoEntry entry_;
  bool has_text_ = false;
  std::string* target_ = nullptr;
  std::string ignored_;
};

}  // namespace

const Line* LineTable::Find(std::string_view id) const {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [id](const Line& line) { return line.id == id; });
  return found == lines.end() ? nullptr : &*found;
}

Result<LineTable> ParseLinesCsv(std::string_view text, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(CheckText(text, where));
  TableBuilder builder;
  CsvReader reader(text, where);
  std::vector<std::string> cells;
  LARARIUM_RETURN_IF_ERROR(reader.Next(cells));
  LARARIUM_ASSIGN_OR_RETURN(const Header header, ReadHeader(cells, reader.Where(), builder));
  while (!reader.AtEnd()) {
    LARARIUM_RETURN_IF_ERROR(reader.Next(cells));
    if (std::all_of(cells.begin(), cells.end(), [](const auto& cell) { return cell.empty(); })) {
      continue;
    }
    if (cells.size() > header.columns.size()) {
      return Status::Error(reader.Where(), "has more cells than the header row",
                           "put texts that hold the separator into quotes");
    }
    LARARIUM_RETURN_IF_ERROR(builder.AddLine(ReadLine(cells, header), reader.Where()));
  }
  return builder.Take();
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

Result<LineTable> ParseLinesJson(std::string_view text, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(CheckText(text, where));
  LineTable table;
  TableBuilder builder;
  LARARIUM_RETURN_IF_ERROR(ReadFields(
      text, where, [&](Fields& fields) { DescribeTable(fields, table, builder); },
      UnknownFields::kIgnore));
  return builder.Take();
}

std::string FormatLinesJson(const LineTable& table) {
  LineTable written = table;
  TableBuilder unused;
  const Json json = WriteFields([&](Fields& fields) { DescribeTable(fields, written, unused); });
  return json.dump(1) + "\n";
}

Result<PoFile> ParsePo(std::string_view text, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(CheckText(text, where));
  text = WithoutByteOrderMark(text);
  PoReader reader(where);
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    LARARIUM_RETURN_IF_ERROR(reader.ReadRow(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.Take();
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

Result<LineTable> LoadLines(const std::filesystem::path& folder) {
  const std::filesystem::path csv = folder / "lines.csv";
  const std::filesystem::path json = folder / "lines.json";
  const bool has_csv = FileExists(csv);
  const bool has_json = FileExists(json);
  if (has_csv && has_json) {
    return Status::Error(json.string(), "lines.csv exists too", "keep one of them");
  }
  if (!has_csv && !has_json) {
    return LineTable();
  }
  const std::filesystem::path& file = has_csv ? csv : json;
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxTableBytes));
  return has_csv ? ParseLinesCsv(text, file.string()) : ParseLinesJson(text, file.string());
}

Status SaveLines(const std::filesystem::path& folder, const LineTable& table) {
  LARARIUM_RETURN_IF_ERROR(ParseLinesCsv(FormatLinesCsv(table), folder.string()).status());
  const std::filesystem::path json = folder / "lines.json";
  if (FileExists(json)) {
    return WriteFileAtomically(json, FormatLinesJson(table));
  }
  return WriteFileAtomically(folder / "lines.csv", FormatLinesCsv(table));
}

}  // namespace lararium::bake
