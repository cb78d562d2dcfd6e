#include "shared/core/number_text.h"

#include <charconv>

#include "shared/core/check.h"

namespace lararium {
namespace {

template <typename T>
bool Take(std::string_view& text, T& value, std::chars_format format) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, format);
  if (error != std::errc()) {
    return false;
  }
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return true;
}

template <typename T>
std::string Format(T value) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof(digits), value);
  CHECK(error == std::errc());
  return std::string(digits, end);
}

}  // namespace

bool TakeNumber(std::string_view& text, float& value) {
  return Take(text, value, std::chars_format::general);
}
bool TakeNumber(std::string_view& text, double& value) {
  return Take(text, value, std::chars_format::general);
}
bool TakeHexNumber(std::string_view& text, double& value) {
  return Take(text, value, std::chars_format::hex);
}

std::string FormatNumber(float value) { return Format(value); }
std::string FormatNumber(double value) { return Format(value); }

}  // namespace lararium
