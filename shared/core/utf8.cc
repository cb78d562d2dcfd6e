#include "shared/core/utf8.h"

#include <array>

namespace lararium {

namespace {

constexpr uint32_t kBad = 0xFFFD;

}  // namespace

uint32_t NextCharacter(std::string_view text, size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at++]);
  if (lead < 0x80) {
    return lead;
  }
  const size_t more = lead >= 0xF0 && lead < 0xF5 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC2 ? 1 : 0;
  if (more == 0 || lead >= 0xF5) {
    return kBad;
  }
  uint32_t character = lead & (0x3Fu >> more);
  for (size_t i = 0; i < more; ++i) {
    if (at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80) {
      return kBad;
    }
    character = (character << 6) | (static_cast<unsigned char>(text[at++]) & 0x3F);
  }
  // The smallest character of each length; smaller ones have a shorter form.
  constexpr std::array<uint32_t, 4> kLeast = {0, 0x80, 0x800, 0x10000};
  const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
  return character < kLeast[more] || character > 0x10FFFF || surrogate ? kBad : character;
}

void AppendCharacter(uint32_t character, std::string& text) {
  const auto put = [&text](uint32_t byte) { text += static_cast<char>(byte); };
  if (character < 0x80) {
    put(character);
    return;
  }
  const int more = character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
  put((0xF00u >> (more + 1) & 0xFFu) | character >> (6 * more));
  for (int shift = 6 * (more - 1); shift >= 0; shift -= 6) {
    put(0x80u | (character >> shift & 0x3Fu));
  }
}

bool IsUtf8(std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const size_t from = at;
    if (NextCharacter(text, at) == kBad && text.substr(from, at - from) != "\xEF\xBF\xBD") {
      return false;
    }
  }
  return true;
}

}  // namespace lararium
