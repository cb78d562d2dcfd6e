#include "editor/bake/caption_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "editor/text/foreign_text.h"
#include "shared/core/lower_case.h"
#include "shared/core/utf8.h"

namespace lararium::bake {
namespace {

constexpr size_t kMaxBytes = size_t{16} << 20;
constexpr size_t kMaxCues = 100'000;
constexpr size_t kMaxText = 1000;  // The limit of captions.json.
constexpr size_t kMaxNotes = 100;
constexpr double kLatest = 360'000.0;  // a hundred hours

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsBlank(char c) { return c == ' ' || c == '\t'; }

// ---- Times ----

// Removes leading blanks and digits; nullopt if there are none or too many.
std::optional<int> TakeNumber(std::string_view& text) {
  text = text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !IsDigit(text.front()) || number > 9'999'999) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return number;
}

// Removes one of the characters, and blanks before it.
bool TakeOneOf(std::string_view characters, std::string_view& text) {
  const size_t at = text.find_first_not_of(" \t");
  if (at == std::string_view::npos || characters.find(text[at]) == std::string_view::npos) {
    return false;
  }
  text.remove_prefix(at + 1);
  return true;
}

// [hours:]minutes:seconds[.fraction] with '.' or ',', with any number of digits and with the blanks
// that translating programs put around ':'.
std::optional<double> TakeTime(std::string_view& text) {
  double seconds = 0.0;
  for (int field = 0; field < 3; ++field) {
    const std::optional<int> number = TakeNumber(text);
    if (!number) {
      return std::nullopt;
    }
    seconds = seconds * 60.0 + *number;
    if (field == 2 || !TakeOneOf(":", text)) {
      if (field == 0) {
        return std::nullopt;
      }
      break;
    }
  }
  if (TakeOneOf(".,", text)) {
    text = text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
    double unit = 0.1;
    for (; !text.empty() && IsDigit(text.front()); text.remove_prefix(1), unit /= 10.0) {
      seconds += unit * (text.front() - '0');
    }
  }
  return seconds <= kLatest ? std::optional(seconds) : std::nullopt;
}

// Removes "-->", or what programs make of it: "->", "-- >", a dash and ">".
bool TakeArrow(std::string_view& text) {
  bool has_dash = false;
  for (text = editor::TrimBlanks(text); !text.empty();) {
    const bool long_dash = text.starts_with("\xE2\x80\x93") || text.starts_with("\xE2\x80\x94");
    if (!long_dash && text.front() != '-' && text.front() != ' ') {
      break;
    }
    has_dash = has_dash || text.front() != ' ';
    text.remove_prefix(long_dash ? 3 : 1);
  }
  const bool is_arrow = has_dash && text.starts_with('>');
  text.remove_prefix(is_arrow ? 1 : 0);
  return is_arrow;
}

struct Timing {
  double begin = 0.0;
  double end = 0.0;
};

// Reads "begin --> end"; ignores the settings or coordinates after it.
std::optional<Timing> ReadTiming(std::string_view row) {
  const std::optional<double> begin = TakeTime(row);
  if (!begin || !TakeArrow(row)) {
    return std::nullopt;
  }
  const std::optional<double> end = TakeTime(row);
  if (!end || (!row.empty() && !IsBlank(row.front()))) {
    return std::nullopt;
  }
  // Thousandths are what both formats can express.
  return Timing{std::round(*begin * 1000.0) / 1000.0, std::round(*end * 1000.0) / 1000.0};
}

// Whether a row was meant as times: it begins as a time does and has an arrow or hours.
bool LooksLikeTiming(std::string_view row) {
  row.remove_prefix(row.starts_with('-') ? 1 : 0);
  if (row.empty() || !IsDigit(row.front())) {
    return false;
  }
  const size_t after = row.find_first_not_of("0123456789:");
  const std::string_view clock = row.substr(0, std::min(after, row.size()));
  return row.find("-->") != std::string_view::npos ||
         (std::count(clock.begin(), clock.end(), ':') >= 2 && clock.back() != ':');
}

// ---- Texts ----

// The character of "&#39;" or "&#x27;", without '&' and ';'.
std::optional<uint32_t> NumberedCharacter(std::string_view entity) {
  if (!entity.starts_with('#')) {
    return std::nullopt;
  }
  entity.remove_prefix(1);
  const bool hex = entity.starts_with('x') || entity.starts_with('X');
  entity.remove_prefix(hex ? 1 : 0);
  uint32_t value = 0;
  const auto [end, error] =
      std::from_chars(entity.data(), entity.data() + entity.size(), value, hex ? 16 : 10);
  const bool whole = error == std::errc() && end == entity.data() + entity.size();
  const bool scalar = value >= 0x20 && value <= 0x10FFFF && (value < 0xD800 || value > 0xDFFF);
  return whole && scalar ? std::optional(value) : std::nullopt;
}

// The character from U+00A0 to U+00FF that HTML gives this name.
std::optional<uint32_t> NamedLatinCharacter(std::string_view name) {
  // In order of the characters, each followed by a blank.
  constexpr std::string_view kNames =
      "nbsp iexcl cent pound curren yen brvbar sect uml copy ordf laquo not shy reg "
      "macr deg plusmn sup2 sup3 acute micro para middot cedil sup1 ordm raquo "
      "frac14 frac12 frac34 iquest Agrave Aacute Acirc Atilde Auml Aring AElig "
      "Ccedil Egrave Eacute Ecirc Euml Igrave Iacute Icirc Iuml ETH Ntilde Ograve "
      "Oacute Ocirc Otilde Ouml times Oslash Ugrave Uacute Ucirc Uuml Yacute THORN "
      "szlig agrave aacute acirc atilde auml aring aelig ccedil egrave eacute ecirc "
      "euml igrave iacute icirc iuml eth ntilde ograve oacute ocirc otilde ouml "
      "divide oslash ugrave uacute ucirc uuml yacute thorn yuml ";
  const std::string word = std::string(name) + " ";
  const size_t at = kNames.find(word);
  if (name.empty() || at == std::string_view::npos || (at > 0 && kNames[at - 1] != ' ')) {
    return std::nullopt;
  }
  const auto before = std::count(kNames.begin(), kNames.begin() + static_cast<ptrdiff_t>(at), ' ');
  return 0xA0 + static_cast<uint32_t>(before);
}

// The length of "&name;" or "&#39;" at the beginning of the row; 0 if there is none.
size_t EntityLength(std::string_view row) {
  constexpr size_t kLongest = 12;
  if (!row.starts_with('&')) {
    return 0;
  }
  const size_t end =
      row.substr(0, kLongest)
          .find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789#", 1);
  return end != std::string_view::npos && end > 1 && row[end] == ';' ? end + 1 : 0;
}

// Decodes the entity at the beginning of the row and removes it; false if there is none that is
// known.
bool TakeEntity(std::string_view& row, std::string& plain) {
  constexpr std::pair<std::string_view, std::string_view> kEntities[] = {
      {"amp", "&"},   {"lt", "<"},     {"gt", ">"},     {"quot", "\""}, {"apos", "'"},
      {"lrm", ""},    {"rlm", ""},     {"hellip", "…"}, {"ndash", "–"}, {"mdash", "—"},
      {"lsquo", "‘"}, {"rsquo", "’"},  {"sbquo", "‚"},  {"ldquo", "“"}, {"rdquo", "”"},
      {"bdquo", "„"}, {"lsaquo", "‹"}, {"rsaquo", "›"}, {"OElig", "Œ"}, {"oelig", "œ"},
      {"euro", "€"}};
  const size_t length = EntityLength(row);
  if (length == 0) {
    return false;
  }
  const std::string_view name = row.substr(1, length - 2);
  const auto known = std::find_if(std::begin(kEntities), std::end(kEntities),
                                  [name](const auto& entity) { return entity.first == name; });
  if (known != std::end(kEntities)) {
    plain += known->second;
  } else if (const auto numbered = NumberedCharacter(name)) {
    AppendCharacter(*numbered, plain);
  } else if (const auto latin = NamedLatinCharacter(name)) {
    AppendCharacter(*latin, plain);
  } else {
    return false;
  }
  row.remove_prefix(length);
  return true;
}

// Length of the tag at the beginning of the row; 0 if there is none.
size_t TagLength(std::string_view row) {
  const bool style = row.starts_with("{\\");
  const bool tag = row.size() > 1 && row.front() == '<' && row[1] != ' ' && row[1] != '<' &&
                   row[1] != '-' && (row[1] != '3' || (row.size() > 2 && IsDigit(row[2])));
  const size_t end = style ? row.find('}') : tag ? row.find('>') : std::string_view::npos;
  return end == std::string_view::npos ? 0 : end + 1;
}

// Removes tags and decodes entities, and the line breaks and blanks of SubStation Alpha ("\N" and
// "\h"), which programs leave in other formats. The first entity that is not known is given back in
// `unknown`.
std::string PlainRow(std::string_view row, std::string& unknown) {
  std::string plain;
  while (!row.empty()) {
    if (const size_t tag = TagLength(row)) {
      row.remove_prefix(tag);
    } else if (row.starts_with("\\N") || row.starts_with("\\h")) {
      plain += row[1] == 'N' ? '\n' : ' ';
      row.remove_prefix(2);
    } else if (!TakeEntity(row, plain)) {
      unknown = unknown.empty() ? row.substr(0, EntityLength(row)) : unknown;
      plain += row.front();
      row.remove_prefix(1);
    }
  }
  return std::string(editor::TrimBlanks(plain));
}

std::string EscapedText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}

// ---- Files ----

enum class RowKind { kBlank, kText, kNumber, kTiming, kBadTiming };

struct Row {
  std::string_view text;  // Blanks around it are left out.
  RowKind kind = RowKind::kBlank;
  Timing timing = {};  // kTiming only.
};

Row ReadRow(std::string_view text) {
  text = editor::TrimBlanks(text);
  if (text.empty()) {
    return {};
  }
  if (const std::optional<Timing> timing = ReadTiming(text)) {
    return {text, RowKind::kTiming, *timing};
  }
  const bool number = std::all_of(text.begin(), text.end(), IsDigit);
  return {text, number                  ? RowKind::kNumber
                : LooksLikeTiming(text) ? RowKind::kBadTiming
                                        : RowKind::kText};
}

// Whether a row begins a comment, style sheet or region of WebVTT.
bool BeginsAside(std::string_view row) {
  constexpr std::string_view kWords[] = {"NOTE", "STYLE", "REGION"};
  return std::any_of(std::begin(kWords), std::end(kWords), [row](std::string_view word) {
    return row.starts_with(word) && (row.size() == word.size() || IsBlank(row[word.size()]));
  });
}

class CaptionReader {
 public:
  CaptionReader(std::string_view text, CaptionFile& file) : file_(file) {
    while (!text.empty()) {
      const size_t end = std::min(text.find('\n'), text.size());
      Row row = ReadRow(text.substr(0, end));
      const bool within = !rows_.empty() && rows_.back().kind != RowKind::kBlank &&
                          rows_.back().kind != RowKind::kNumber;
      if (row.kind == RowKind::kBadTiming && within && row.text.find("-->") == row.text.npos) {
        row.kind = RowKind::kText;  // The text tells the time of day.
      }
      last_ = row.kind == RowKind::kBlank ? last_ : rows_.size() + 1;
      rows_.push_back(row);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    web_ = !rows_.empty() && IsWebHeader(rows_[0].text);
  }

  static bool IsWebHeader(std::string_view row) {
    return row.starts_with("WEBVTT") && (row.size() == 6 || IsBlank(row[6]));
  }

  // False if there are too many captions.
  bool Read() {
    size_t begin = web_ ? EndOfHeader() : 0;
    first_ = begin;
    size_t timing = NextTiming(begin);
    CheckAside(begin, HeadOf(timing, begin));
    while (timing < rows_.size()) {
      const size_t next = NextTiming(timing + 1);
      const size_t end = HeadOf(next, timing + 1);
      AddCue(HeadOf(timing, begin), timing, end);
      if (file_.cues.size() > kMaxCues) {
        return false;
      }
      begin = timing + 1;
      timing = next;
    }
    if (unsaid_ > 0) {
      file_.notes.push_back("and " + std::to_string(unsaid_) + " more notes of this kind");
    }
    return true;
  }

 private:
  // The metadata under "WEBVTT" end at a blank row or at the first caption.
  size_t EndOfHeader() const {
    size_t end = 1;
    while (end < rows_.size() && rows_[end].kind != RowKind::kBlank && !IsTiming(end)) {
      ++end;
    }
    const bool has_identifier = end < rows_.size() && IsTiming(end) && end > 1 &&
                                rows_[end - 1].text.find_first_of(":=") == std::string_view::npos;
    return has_identifier ? end - 1 : end;
  }

  bool IsTiming(size_t row) const {
    return rows_[row].kind == RowKind::kTiming || rows_[row].kind == RowKind::kBadTiming;
  }

  size_t NextTiming(size_t from) const {
    while (from < rows_.size() && !IsTiming(from)) {
      ++from;
    }
    return from;
  }

  bool IsBlankAt(size_t row) const { return rows_[row].kind == RowKind::kBlank; }

  // The row at which the caption with this timing begins: that of its number or identifier, which
  // may be separated from the timing by blank rows, or the timing itself. Rows before `from` belong
  // to another caption.
  size_t HeadOf(size_t timing, size_t from) const {
    size_t id = timing;
    while (id > from && IsBlankAt(id - 1)) {
      --id;
    }
    if (id == from || timing == rows_.size()) {
      return timing;
    }
    --id;
    const bool adjacent = id + 1 == timing;
    const bool alone = id == first_ || IsBlankAt(id - 1);
    const bool number = rows_[id].kind == RowKind::kNumber;
    return (adjacent && alone) || (number && (adjacent || alone)) ? id : timing;
  }

  void Note(size_t row, const std::string& what, const char* outcome = "it was left out") {
    if (file_.notes.size() < kMaxNotes) {
      file_.notes.push_back("line " + std::to_string(row + 1) + ": " + what + "; " + outcome);
    } else {
      ++unsaid_;
    }
  }

  // Skips a comment, style sheet or region from its first row on; returns the row behind it.
  size_t EndOfAside(size_t row, size_t end) const {
    while (row < end && !IsBlankAt(row)) {
      ++row;
    }
    return row;
  }

  bool IsAside(size_t row, size_t from) const {
    return web_ && BeginsAside(rows_[row].text) && (row == from || IsBlankAt(row - 1));
  }

  // Tells of texts before the first caption.
  void CheckAside(size_t from, size_t end) {
    for (size_t row = from; row < std::min(end, rows_.size()); ++row) {
      if (IsAside(row, from)) {
        row = EndOfAside(row, end);
      } else if (!IsBlankAt(row)) {
        Note(row, Quoted(row) + " has no time such as 00:00:01,000 --> 00:00:02,500");
      }
    }
  }

  std::string Quoted(size_t row) const {
    constexpr size_t kMost = 40;
    const std::string_view text = rows_[row].text;
    size_t end = std::min(text.size(), kMost);
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) {
      --end;
    }
    return "\"" + std::string(text.substr(0, end)) + (end < text.size() ? "…\"" : "\"");
  }

  // Adds the caption whose text ends before `end`.
  void AddCue(size_t head, size_t timing, size_t end) {
    if (rows_[timing].kind == RowKind::kBadTiming) {
      return Note(timing, Quoted(timing) + " is not a time such as 00:00:01,000 --> 00:00:02,500");
    }
    FileCue cue;
    cue.id = head < timing ? rows_[head].text : std::string_view();
    cue.begin = rows_[timing].timing.begin;
    cue.end = rows_[timing].timing.end;
    cue.text = TextOf(timing + 1, end);
    if (cue.text.empty()) {
      return Note(timing, "the caption has no text");
    }
    if (!(cue.end > cue.begin)) {
      return Note(timing, "the caption ends before it begins");
    }
    if (cue.text.size() > kMaxText || cue.id.size() > kMaxText) {
      return Note(timing, "the caption is longer than 1000 bytes");
    }
    file_.cues.push_back(std::move(cue));
  }

  // The rows of a caption; blank ones are left out.
  std::string TextOf(size_t from, size_t end) {
    while (end > from && IsBlankAt(end - 1)) {
      --end;
    }
    // Some programs end their files with a number that no caption follows.
    if (end == last_ && end > from + 1 && rows_[end - 1].kind == RowKind::kNumber &&
        IsBlankAt(end - 2)) {
      --end;
      Note(end, "the caption " + Quoted(end) + " has no time and no text");
    }
    std::string text;
    for (size_t row = from; row < end; ++row) {
      if (IsAside(row, end)) {
        row = EndOfAside(row, end);
        continue;
      }
      std::string unknown;
      const std::string plain = PlainRow(rows_[row].text, unknown);
      if (!unknown.empty()) {
        Note(row, "\"" + unknown + "\" is not the name of a character", "it is shown as it is");
      }
      text += (text.empty() || plain.empty() ? "" : "\n") + plain;
    }
    return text;
  }

  CaptionFile& file_;
  std::vector<Row> rows_;
  bool web_ = false;
  size_t first_ = 0;   // First row behind the header.
  size_t last_ = 0;    // The row behind the last one that is not blank.
  size_t unsaid_ = 0;  // Number of notes beyond kMaxNotes.
};

// ---- Captions as they are shown ----

// Overlaps that are not longer come from rounding and from fades, and are no captions to be read
// together.
constexpr double kShortOverlap = 0.5;  // The unit is seconds.

std::string OneRow(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// At most two rows: the first caption, and all others behind it.
std::string TextTogether(std::span<const FileCue* const> cues) {
  if (cues.size() > 1) {
    std::string text = OneRow(cues[0]->text);
    for (size_t i = 1; i < cues.size(); ++i) {
      text += (i == 1 ? "\n" : " ") + OneRow(cues[i]->text);
    }
    return text;
  }
  std::string text = cues[0]->text;
  if (std::count(text.begin(), text.end(), '\n') > 1) {
    text = OneRow(std::move(text));
    const size_t middle = text.find(' ', text.size() / 2);
    if (middle != std::string::npos) {
      text[middle] = '\n';
    }
  }
  return text;
}

std::string FormatTime(double seconds, char point) {
  const auto all = static_cast<int64_t>(std::llround(std::max(seconds, 0.0) * 1000.0));
  char text[40];
  std::snprintf(text, sizeof(text), "%02d:%02d:%02d%c%03d", static_cast<int>(all / 3'600'000),
                static_cast<int>(all / 60'000 % 60), static_cast<int>(all / 1000 % 60), point,
                static_cast<int>(all % 1000));
  return text;
}

}  // namespace

Result<CaptionFile> ParseCaptionFile(std::string_view text, const std::string& where) {
  if (text.size() > kMaxBytes) {
    return Status::Error(where, "is longer than 16 MiB");
  }
  LARARIUM_ASSIGN_OR_RETURN(const editor::ForeignText decoded, editor::DecodeText(text, where));
  const std::string_view head = editor::TrimBlanks(std::string_view(decoded.text).substr(0, 8));
  if (LowerCase(head).starts_with("webvtt") && !head.starts_with("WEBVTT")) {
    return Status::Error(where + ": line 1", "a WebVTT file begins with WEBVTT in capital letters",
                         "correct its first line");
  }
  CaptionFile file;
  CaptionReader reader(decoded.text, file);
  if (!reader.Read()) {
    return Status::Error(where, "has more than a hundred thousand captions");
  }
  if (file.cues.empty() && !file.notes.empty()) {
    return Status::Error(where, "no caption can be read: " + file.notes.front());
  }
  if (!decoded.note.empty()) {
    file.notes.insert(file.notes.begin(), decoded.note);
  }
  return file;
}

std::vector<stage::CaptionCue> ShownCues(std::vector<FileCue> cues) {
  std::stable_sort(cues.begin(), cues.end(),
                   [](const FileCue& a, const FileCue& b) { return a.begin < b.begin; });
  std::vector<FileCue> merged;  // No two of these begin together.
  for (FileCue& cue : cues) {
    if (merged.empty() || cue.begin > merged.back().begin) {
      merged.push_back(std::move(cue));
      continue;
    }
    merged.back().end = std::max(merged.back().end, cue.end);
    merged.back().text = OneRow(std::move(merged.back().text)) + "\n" + OneRow(std::move(cue.text));
  }
  for (size_t i = 0; i + 1 < merged.size(); ++i) {
    const FileCue& next = merged[i + 1];
    if (next.end > merged[i].end && merged[i].end - next.begin <= kShortOverlap) {
      merged[i].end = std::min(merged[i].end, next.begin);
    }
  }
  std::vector<stage::CaptionCue> shown;
  std::vector<const FileCue*> present;
  const auto show_until = [&](double end) {
    while (!present.empty()) {
      const double begin = shown.empty() ? present.front()->begin
                                         : std::max(present.back()->begin, shown.back().end);
      double until = end;
      for (const FileCue* cue : present) {
        until = std::min(until, cue->end);
      }
      if (until > begin) {
        shown.push_back({begin, until, TextTogether(present)});
      }
      if (until >= end) {
        break;
      }
      std::erase_if(present, [until](const FileCue* cue) { return cue->end <= until; });
    }
  };
  for (const FileCue& cue : merged) {
    show_until(cue.begin);
    std::erase_if(present, [&cue](const FileCue* other) { return other->end <= cue.begin; });
    present.push_back(&cue);
  }
  show_until(std::numeric_limits<double>::infinity());
  return shown;
}

std::string FormatSrt(const std::vector<FileCue>& cues) {
  std::string text;
  int number = 0;
  for (const FileCue& cue : cues) {
    text += std::to_string(++number) + "\n" + FormatTime(cue.begin, ',') + " --> " +
            FormatTime(cue.end, ',') + "\n" + cue.text + "\n\n";
  }
  return text;
}

std::string FormatVtt(const std::vector<FileCue>& cues) {
  std::string text = "WEBVTT\n\n";
  for (const FileCue& cue : cues) {
    text += (cue.id.empty() ? "" : cue.id + "\n") + FormatTime(cue.begin, '.') + " --> " +
            FormatTime(cue.end, '.') + "\n" + EscapedText(cue.text) + "\n\n";
  }
  return text;
}

}  // namespace lararium::bake
