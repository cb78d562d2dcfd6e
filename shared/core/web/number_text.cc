#include "shared/core/number_text.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

// The standard library of emscripten 3.1.6 has no std::from_chars and std::to_chars of fractions.

namespace lararium {
namespace {

float Read(const char* text, char** end, float /*kind*/) { return std::strtof(text, end); }
double Read(const char* text, char** end, double /*kind*/) { return std::strtod(text, end); }

constexpr std::string_view kDecimal = "0123456789.eE+-";
constexpr std::string_view kHex = "0123456789abcdefABCDEF.pP+-";

// `prefix` precedes the digits for strtod.
template <typename T>
bool Take(std::string_view& text, T& value, std::string_view digits, const std::string& prefix) {
  const bool negative = text.starts_with('-');
  const std::string_view number = text.substr(negative ? 1 : 0);
  const std::string copy = prefix + std::string(number.substr(0, number.find_first_not_of(digits)));
  if (copy.size() == prefix.size() || number.starts_with('+') || number.starts_with('-')) {
    return false;
  }
  char* end = nullptr;
  errno = 0;
  const T read = Read(copy.c_str(), &end, T());
  const auto length = static_cast<size_t>(end - copy.c_str());
  const bool too_far = errno == ERANGE && (read == T() || std::isinf(read));
  if (too_far || length <= prefix.size()) {
    return false;
  }
  value = negative ? -read : read;
  text.remove_prefix(length - prefix.size() + (negative ? 1 : 0));
  return true;
}

// The fewest digits that give the number back, in the shorter of the two notations.
template <typename T>
std::string Format(T value) {
  char digits[400];
  int precision = 0;  // The number of digits behind the first one.
  for (; precision < 17; ++precision) {
    std::snprintf(digits, sizeof(digits), "%.*e", precision, static_cast<double>(value));
    if (Read(digits, nullptr, T()) == value) {
      break;
    }
  }
  const std::string scientific = digits;
  const size_t at = scientific.find('e');
  if (at == std::string::npos) {
    return scientific;  // The value is infinite or not a number.
  }
  const int behind_point = precision - std::atoi(scientific.c_str() + at + 1);
  std::snprintf(digits, sizeof(digits), "%.*f", behind_point > 0 ? behind_point : 0,
                static_cast<double>(value));
  const std::string fixed = digits;
  return fixed.size() <= scientific.size() ? fixed : scientific;
}

}  // namespace

bool TakeNumber(std::string_view& text, float& value) { return Take(text, value, kDecimal, ""); }
bool TakeNumber(std::string_view& text, double& value) { return Take(text, value, kDecimal, ""); }
bool TakeHexNumber(std::string_view& text, double& value) { return Take(text, value, kHex, "0x"); }

std::string FormatNumber(float value) { return Format(value); }
std::string FormatNumber(double value) { return Format(value); }

}  // namespace lararium
