#include "shared/core/plain_text.h"

#include <utility>

#include "shared/core/utf8.h"

namespace lararium {
namespace {

enum class Order { kLittle, kBig };

std::optional<Order> OrderOf(std::string_view bytes) {
  if (bytes.size() < 2) {
    return std::nullopt;
  }
  if (bytes.starts_with("\xFF\xFE") || (bytes[0] != '\0' && bytes[1] == '\0')) {
    return Order::kLittle;
  }
  if (bytes.starts_with("\xFE\xFF") || (bytes[0] == '\0' && bytes[1] != '\0')) {
    return Order::kBig;
  }
  return std::nullopt;
}

std::optional<std::string> FromUtf16(std::string_view bytes, Order order) {
  std::u16string text;
  text.reserve(bytes.size() / 2);
  const size_t low = order == Order::kLittle ? 0 : 1;
  for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const auto unit = static_cast<char16_t>(static_cast<unsigned char>(bytes[i + 1 - low]) << 8 |
                                            static_cast<unsigned char>(bytes[i + low]));
    if (unit == 0) {
      return std::nullopt;
    }
    text += unit;
  }
  return Utf8FromUtf16(text.starts_with(u'\uFEFF') ? std::u16string_view(text).substr(1) : text);
}

}  // namespace

bool LooksLikeUtf16(std::string_view bytes) { return OrderOf(bytes).has_value(); }

std::optional<std::string> Utf8FromUtf16(std::u16string_view text) {
  std::string utf8;
  utf8.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    uint32_t character = text[i];
    if (character >= 0xD800 && character < 0xE000) {
      const uint32_t next = i + 1 < text.size() ? text[i + 1] : 0;
      if (character >= 0xDC00 || next < 0xDC00 || next >= 0xE000) {
        return std::nullopt;
      }
      character = 0x10000 + ((character - 0xD800) << 10) + (next - 0xDC00);
      ++i;
    }
    AppendCharacter(character, utf8);
  }
  return utf8;
}

std::string WithUnixLineEnds(std::string text) {
  const size_t first = text.find('\r');
  if (first == std::string::npos) {
    return text;
  }
  size_t to = first;
  for (size_t from = first; from < text.size(); ++from) {
    if (text[from] == '\r' && from + 1 < text.size() && text[from + 1] == '\n') {
      continue;
    }
    text[to++] = text[from] == '\r' ? '\n' : text[from];
  }
  text.resize(to);
  return text;
}

std::string PlainText(std::string bytes) {
  if (const std::optional<Order> order = OrderOf(bytes)) {
    bytes = FromUtf16(bytes, *order).value_or(std::move(bytes));
  }
  // Programs that do not know of the mark that is there put a second one before it.
  while (bytes.size() != WithoutByteOrderMark(bytes).size()) {
    bytes.erase(0, bytes.size() - WithoutByteOrderMark(bytes).size());
  }
  return WithUnixLineEnds(std::move(bytes));
}

}  // namespace lararium
