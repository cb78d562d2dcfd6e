#include "editor/panels/widgets/wrapped_text.h"

#include <algorithm>
#include <vector>

namespace lararium::panels {

namespace {

constexpr std::string_view kEnd = "\xee\x80\x80";    // kRowEnd in UTF-8
constexpr std::string_view kBegin = "\xee\x80\x81";  // kRowBegin in UTF-8.
constexpr std::string_view kBreak = "\xee\x80\x80\n\xee\x80\x81";

bool Continues(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

// The first byte of the character after the one at `at`.
size_t NextLetter(std::string_view text, size_t at) {
  ++at;
  while (at < text.size() && Continues(text[at])) {
    ++at;
  }
  return std::min(at, text.size());
}

std::string_view WithoutSpacesBehind(std::string_view row) {
  return row.substr(0, row.find_last_not_of(' ') + 1);
}

// The position behind the word that begins at `at` and the spaces that follow it.
size_t BehindWord(std::string_view line, size_t at) {
  const size_t space = line.find(' ', line.find_first_not_of(' ', at));
  return std::min(line.find_first_not_of(' ', space), line.size());
}

// The number of bytes in the first row: all of the line where it fits.
size_t RowLength(std::string_view line, float width, const TextWidth& width_of) {
  size_t length = 0;
  while (length < line.size()) {
    const size_t next = BehindWord(line, length);
    if (width_of(WithoutSpacesBehind(line.substr(0, next))) > width) {
      break;
    }
    length = next;
  }
  if (length > 0 || line.empty()) {
    return length;
  }
  length = NextLetter(line, 0);
  for (size_t next = length; next < line.size(); length = next) {
    next = NextLetter(line, length);
    if (width_of(line.substr(0, next)) > width) {
      break;
    }
  }
  return length;
}

void DeleteLastLetter(std::string& text) {
  while (!text.empty() && Continues(text.back())) {
    text.pop_back();
  }
  if (!text.empty()) {
    text.pop_back();
  }
}

// The number of bytes of a row break at `at`, or of what remains of one after an edit.
size_t BreakLength(std::string_view wrapped, size_t at) {
  const std::string_view rest = wrapped.substr(at);
  for (const std::string_view part :
       {kBreak, kBreak.substr(0, 4), kBreak.substr(3), kEnd, kBegin}) {
    if (rest.starts_with(part)) {
      return part.size();
    }
  }
  return 0;
}

}  // namespace

std::string WrapText(std::string_view text, float width, const TextWidth& width_of) {
  std::string wrapped;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    while (true) {
      const size_t length = RowLength(line, width, width_of);
      wrapped += line.substr(0, length);
      line.remove_prefix(length);
      if (line.empty()) {
        break;
      }
      wrapped += kBreak;
    }
    if (end < text.size()) {
      wrapped += '\n';
    }
    begin = end + 1;
  }
  return wrapped;
}

std::string UnwrapText(std::string_view wrapped, std::span<size_t> positions) {
  const std::vector<size_t> were(positions.begin(), positions.end());
  std::string text;
  const auto note = [&](size_t from, size_t to) {
    for (size_t i = 0; i < were.size(); ++i) {
      if (were[i] >= from && were[i] < to) {
        positions[i] = text.size();
      }
    }
  };
  for (size_t at = 0; at < wrapped.size();) {
    const size_t length = BreakLength(wrapped, at);
    if (length == 0) {
      note(at, at + 1);
      text += wrapped[at++];
      continue;
    }
    const std::string_view found = wrapped.substr(at, length);
    if (found == kBreak.substr(0, 4)) {
      DeleteLastLetter(text);
    }
    size_t next = at + length;
    if (found == kBreak.substr(3) && next < wrapped.size()) {
      next = NextLetter(wrapped, next);
    }
    note(at, next);
    at = next;
  }
  note(wrapped.size(), std::string_view::npos);
  for (size_t& position : positions) {
    position = std::min(position, text.size());
  }
  return text;
}

size_t PositionInWrapped(std::string_view wrapped, size_t position) {
  size_t at = 0;
  for (size_t of_text = 0; at < wrapped.size();) {
    const size_t length = BreakLength(wrapped, at);
    if (length > 0) {
      at += length;
    } else if (of_text++ == position) {
      break;
    } else {
      ++at;
    }
  }
  return at;
}

size_t OutOfRowBreak(std::string_view wrapped, size_t position, bool on) {
  const size_t earliest = position < kBreak.size() ? 0 : position - kBreak.size() + 1;
  for (size_t at = earliest; at < position; ++at) {
    if (wrapped.substr(at).starts_with(kBreak)) {
      return on ? at + kBreak.size() : at;
    }
  }
  return position;
}

}  // namespace lararium::panels
