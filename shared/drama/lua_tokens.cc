#include "shared/drama/lua_tokens.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "shared/core/number_text.h"

namespace lararium::drama {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsHexDigit(char c) { return IsDigit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool IsNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool IsNamePart(char c) { return IsNameStart(c) || IsDigit(c); }
bool IsBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

int HexValue(char c) { return IsDigit(c) ? c - '0' : (c | 0x20) - 'a' + 10; }

// Level of the long bracket that begins here, such as 2 for "[==["; -1: there is none.
int LongLevel(std::string_view text, size_t begin) {
  if (begin >= text.size() || text[begin] != '[') {
    return -1;
  }
  size_t at = begin + 1;
  while (at < text.size() && text[at] == '=') {
    ++at;
  }
  return at < text.size() && text[at] == '[' ? static_cast<int>(at - begin - 1) : -1;
}

// Appends a code point as UTF-8 with up to 31 bits, like Lua.
void AppendCodepoint(uint32_t code, std::string& out) {
  if (code < 0x80) {
    out += static_cast<char>(code);
    return;
  }
  char reversed[6];
  int count = 0;
  uint32_t first_limit = 0x3f;  // Limit of the first byte.
  do {
    reversed[count++] = static_cast<char>(0x80 | (code & 0x3f));
    code >>= 6;
    first_limit >>= 1;
  } while (code > first_limit);
  out += static_cast<char>((~first_limit << 1) | code);
  while (count > 0) {
    out += reversed[--count];
  }
}

// Decodes one escape of a quoted text; `at` is after the backslash. False: unknown escape.
bool AppendEscape(std::string_view text, size_t& at, std::string& out) {
  constexpr std::string_view kLetters = "abfnrtv\\\"'\n";
  constexpr std::string_view kMeanings = "\a\b\f\n\r\t\v\\\"'\n";
  const char c = text[at++];
  if (const size_t known = kLetters.find(c); known != std::string_view::npos) {
    out += kMeanings[known];
    return true;
  }
  if (c == 'z') {
    while (at < text.size() && IsBlank(text[at])) {
      ++at;
    }
    return true;
  }
  if (c == 'x') {
    if (at + 2 > text.size() || !IsHexDigit(text[at]) || !IsHexDigit(text[at + 1])) {
      return false;
    }
    out += static_cast<char>(16 * HexValue(text[at]) + HexValue(text[at + 1]));
    at += 2;
    return true;
  }
  if (c == 'u') {
    const size_t close = text.find('}', at);
    uint32_t code = 0;
    if (close == std::string_view::npos || text[at] != '{') {
      return false;
    }
    const char* const end = text.data() + close;
    const auto [stop, error] = std::from_chars(text.data() + at + 1, end, code, 16);
    at = close + 1;
    if (error != std::errc() || stop != end || code >= 0x80000000u) {
      return false;
    }
    AppendCodepoint(code, out);
    return true;
  }
  int value = 0;
  size_t digits = 0;
  --at;
  while (digits < 3 && at < text.size() && IsDigit(text[at])) {
    value = 10 * value + (text[at++] - '0');
    ++digits;
  }
  out += static_cast<char>(value);
  return digits > 0 && value < 256;
}

}  // namespace

// Skips a long bracket whose first '[' is at begin; false: it is never closed.
bool LuaTokens::SkipLong(size_t begin) {
  const int level = LongLevel(text_, begin);
  const std::string close = "]" + std::string(static_cast<size_t>(level), '=') + "]";
  const size_t found = text_.find(close, begin + static_cast<size_t>(level) + 2);
  next_ = found == std::string_view::npos ? text_.size() : found + close.size();
  return found != std::string_view::npos;
}

bool LuaTokens::SkipBlanks(LuaToken& bad) {
  for (;;) {
    while (next_ < text_.size() && IsBlank(text_[next_])) {
      ++next_;
    }
    if (!text_.substr(next_).starts_with("--")) {
      return true;
    }
    const size_t begin = next_;
    if (LongLevel(text_, begin + 2) >= 0) {
      if (!SkipLong(begin + 2)) {
        bad = {LuaToken::Kind::kBad, begin, text_.size(), 0, "this comment never ends"};
        return false;
      }
    } else {
      next_ = std::min(text_.find('\n', begin), text_.size());
    }
  }
}

LuaToken LuaTokens::LongText(size_t begin) {
  if (!SkipLong(begin)) {
    return {LuaToken::Kind::kBad, begin, text_.size(), 0, "this text never ends"};
  }
  return {LuaToken::Kind::kText, begin, next_};
}

LuaToken LuaTokens::QuotedText(size_t begin) {
  const char quote = text_[begin];
  for (size_t at = begin + 1; at < text_.size() && text_[at] != '\n'; ++at) {
    if (text_[at] == quote) {
      next_ = at + 1;
      return {LuaToken::Kind::kText, begin, next_};
    }
    if (text_[at] != '\\' || at + 1 >= text_.size()) {
      continue;
    }
    ++at;  // The escaped character.
    if (text_[at] == 'z') {
      while (at + 1 < text_.size() && IsBlank(text_[at + 1])) {
        ++at;
      }
    }
  }
  next_ = text_.size();
  return {LuaToken::Kind::kBad, begin, text_.size(), 0, "this text never ends"};
}

LuaToken LuaTokens::Number(size_t begin) {
  const bool hex = begin + 1 < text_.size() && text_[begin] == '0' &&
                   (text_[begin + 1] == 'x' || text_[begin + 1] == 'X');
  size_t at = begin + (hex ? 2 : 0);
  while (at < text_.size()) {
    const char lower = static_cast<char>(text_[at] | 0x20);
    const bool exponent = lower == (hex ? 'p' : 'e');
    if (exponent && at + 1 < text_.size() && (text_[at + 1] == '+' || text_[at + 1] == '-')) {
      at += 2;
    } else if (IsNamePart(text_[at]) || text_[at] == '.') {
      ++at;
    } else {
      break;
    }
  }
  next_ = at;
  if (!NumberOf(text_.substr(begin, at - begin))) {
    return {LuaToken::Kind::kBad, begin, at, 0, "this is no number"};
  }
  return {LuaToken::Kind::kNumber, begin, at};
}

LuaToken LuaTokens::Next() {
  LuaToken bad;
  if (!SkipBlanks(bad)) {
    return bad;
  }
  const size_t begin = next_;
  if (begin >= text_.size()) {
    return {LuaToken::Kind::kEnd, begin, begin};
  }
  const char c = text_[begin];
  const char after = begin + 1 < text_.size() ? text_[begin + 1] : '\0';
  if (IsNameStart(c)) {
    while (next_ < text_.size() && IsNamePart(text_[next_])) {
      ++next_;
    }
    return {LuaToken::Kind::kName, begin, next_};
  }
  if (IsDigit(c) || (c == '.' && IsDigit(after))) {
    return Number(begin);
  }
  if (c == '"' || c == '\'') {
    return QuotedText(begin);
  }
  if (LongLevel(text_, begin) >= 0) {
    return LongText(begin);
  }
  // Only those symbols of several characters matter that contain a symbol we look for.
  const std::string_view rest = text_.substr(begin);
  size_t length = 1;
  for (const std::string_view symbol : {"...", "..", "==", "~=", "<=", ">=", "::"}) {
    if (rest.starts_with(symbol)) {
      length = symbol.size();
      break;
    }
  }
  next_ = begin + length;
  return {LuaToken::Kind::kSymbol, begin, next_, c};
}

std::optional<double> NumberOf(std::string_view token) {
  const bool hex = token.size() > 2 && token[0] == '0' && (token[1] | 0x20) == 'x';
  if (hex) {
    token.remove_prefix(2);
  }
  double value = 0.0;
  const bool read = hex ? TakeHexNumber(token, value) : TakeNumber(token, value);
  if (!read || !token.empty() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::string> TextOf(std::string_view token) {
  if (const int level = LongLevel(token, 0); level >= 0) {
    const auto bracket = static_cast<size_t>(level) + 2;
    std::string_view inside = token.substr(bracket, token.size() - 2 * bracket);
    if (inside.starts_with("\r\n")) {
      inside.remove_prefix(2);
    } else if (inside.starts_with('\n')) {
      inside.remove_prefix(1);
    }
    return std::string(inside);
  }
  const std::string_view inside = token.substr(1, token.size() - 2);
  std::string out;
  for (size_t at = 0; at < inside.size();) {
    if (inside[at] != '\\') {
      out += inside[at++];
    } else if (++at >= inside.size() || !AppendEscape(inside, at, out)) {
      return std::nullopt;
    }
  }
  return out;
}

LuaPosition PositionOf(std::string_view text, size_t offset) {
  const std::string_view before = text.substr(0, offset);
  LuaPosition position;
  position.line = 1 + static_cast<size_t>(std::count(before.begin(), before.end(), '\n'));
  const size_t newline = before.rfind('\n');
  position.column = newline == std::string_view::npos ? offset + 1 : offset - newline;
  return position;
}

}  // namespace lararium::drama
