#include "editor/bake/caption_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "shared/core/byte_order_mark.h"

namespace lararium::bake {
namespace {

constexpr size_t kMaxBytes = size_t{16} << 20;
constexpr size_t kMaxCues = 100'000;
constexpr size_t kMaxText = 4000;
constexpr double kLatest = 360'000.0;  // a hundred hours

std::string_view Trim(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t\r");
  return begin == std::string_view::npos
             ? std::string_view()
             : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

// Removes leading digits; nullopt if there are none or too many.
std::optional<int> TakeNumber(std::string_view& text) {
  size_t digits = 0;
  int number = 0;
  while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9' && digits < 7) {
    number = number * 10 + (text[digits++] - '0');
  }
  text.remove_prefix(digits);
  return digits > 0 ? std::optional(number) : std::nullopt;
}

// [hours:]minutes:seconds[.,]thousandths
std::optional<double> TakeTime(std::string_view& text) {
  double seconds = 0.0;
  for (int field = 0; field < 3; ++field) {
    const std::optional<int> number = TakeNumber(text);
    if (!number) {
      return std::nullopt;
    }
    seconds = seconds * 60.0 + *number;
    if (text.empty() || text.front() != ':') {
      if (field == 0) {
        return std::nullopt;
      }
      break;
    }
    text.remove_prefix(1);
  }
  if (text.empty() || (text.front() != '.' && text.front() != ',')) {
    return std::nullopt;
  }
  text.remove_prefix(1);
  const size_t before = text.size();
  const std::optional<int> fraction = TakeNumber(text);
  if (!fraction || before - text.size() != 3 || seconds > kLatest) {
    return std::nullopt;
  }
  return seconds + *fraction / 1000.0;
}

// Reads "begin --> end"; ignores the settings of WebVTT after it.
bool ReadTiming(std::string_view row, FileCue& cue) {
  row = Trim(row);
  const std::optional<double> begin = TakeTime(row);
  row = Trim(row);
  if (!begin || !row.starts_with("-->")) {
    return false;
  }
  row = Trim(row.substr(3));
  const std::optional<double> end = TakeTime(row);
  if (!end || (!row.empty() && row.front() != ' ' && row.front() != '\t')) {
    return false;
  }
  cue.begin = *begin;
  cue.end = *end;
  return true;
}

// Removes tags and decodes entities.
std::string PlainText(std::string_view row) {
  constexpr std::pair<std::string_view, std::string_view> kEntities[] = {
      {"&amp;", "&"},         {"&lt;", "<"}, {"&gt;", ">"},
      {"&nbsp;", "\xC2\xA0"}, {"&lrm;", ""}, {"&rlm;", ""}};
  std::string plain;
  while (!row.empty()) {
    const char close = row.front() == '<' ? '>' : row.starts_with("{\\") ? '}' : '\0';
    const size_t end = close != '\0' ? row.find(close) : std::string_view::npos;
    if (end != std::string_view::npos) {
      row.remove_prefix(end + 1);
      continue;
    }
    const auto entity =
        std::find_if(std::begin(kEntities), std::end(kEntities),
                     [row](const auto& known) { return row.starts_with(known.first); });
    if (entity != std::end(kEntities)) {
      plain += entity->second;
      row.remove_prefix(entity->first.size());
    } else {
      plain += row.front();
      row.remove_prefix(1);
    }
  }
  return plain;
}

std::string EscapedText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}

// Both formats consist of blocks of rows that are separated by empty rows.
struct Block {
  int row = 0;  // Row of the file, from 1.
  std::vector<std::string_view> rows;
};

std::vector<Block> Blocks(std::string_view text) {
  std::vector<Block> blocks;
  bool inside = false;
  for (int row = 1; !text.empty(); ++row) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view trimmed = Trim(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (trimmed.empty()) {
      inside = false;
      continue;
    }
    if (!inside) {
      blocks.push_back({row, {}});
      inside = true;
    }
    blocks.back().rows.push_back(trimmed);
  }
  return blocks;
}

Result<FileCue> ReadCue(const Block& block, const std::string& place) {
  const std::string where = place + ": line " + std::to_string(block.row);
  FileCue cue;
  size_t next = 0;
  if (block.rows[0].find("-->") == std::string_view::npos) {
    cue.id = block.rows[0];
    ++next;
  }
  if (next >= block.rows.size() || !ReadTiming(block.rows[next], cue)) {
    return Status::Error(where, "a time such as 00:00:01,000 --> 00:00:02,500 is missing");
  }
  if (!(cue.end > cue.begin)) {
    return Status::Error(where, "the caption ends before it begins");
  }
  for (++next; next < block.rows.size(); ++next) {
    const std::string row = PlainText(block.rows[next]);
    cue.text += (cue.text.empty() || row.empty() ? "" : "\n") + row;
  }
  if (cue.text.size() > kMaxText || cue.id.size() > kMaxText) {
    return Status::Error(where, "the caption is longer than 4000 bytes");
  }
  return cue;
}

Status CheckSize(std::string_view text, const std::string& where) {
  return text.size() > kMaxBytes ? Status::Error(where, "is longer than 16 MiB") : Status();
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

Result<std::vector<FileCue>> ParseSrt(std::string_view text, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(CheckSize(text, where));
  std::vector<FileCue> cues;
  for (const Block& block : Blocks(WithoutByteOrderMark(text))) {
    if (cues.size() >= kMaxCues) {
      return Status::Error(where, "has more than a hundred thousand captions");
    }
    LARARIUM_ASSIGN_OR_RETURN(cues.emplace_back(), ReadCue(block, where));
  }
  return cues;
}

Result<std::vector<FileCue>> ParseVtt(std::string_view text, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(CheckSize(text, where));
  const std::vector<Block> blocks = Blocks(WithoutByteOrderMark(text));
  if (blocks.empty() || !blocks[0].rows[0].starts_with("WEBVTT")) {
    return Status::Error(where, "does not begin with WEBVTT");
  }
  std::vector<FileCue> cues;
  for (size_t i = 1; i < blocks.size(); ++i) {
    const std::string_view head = blocks[i].rows[0];
    if (head.starts_with("NOTE") || head.starts_with("STYLE") || head.starts_with("REGION")) {
      continue;
    }
    if (cues.size() >= kMaxCues) {
      return Status::Error(where, "has more than a hundred thousand captions");
    }
    LARARIUM_ASSIGN_OR_RETURN(cues.emplace_back(), ReadCue(blocks[i], where));
  }
  return cues;
}

Result<std::vector<FileCue>> ParseCaptionFile(std::string_view text, const std::string& where) {
  return WithoutByteOrderMark(text).starts_with("WEBVTT") ? ParseVtt(text, where)
                                                          : ParseSrt(text, where);
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
