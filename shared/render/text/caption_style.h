#pragma once

// The visitor's choice of letter size and contrast for captions, the guide's words and the menu.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace lararium::render {

enum class CaptionSize { kNormal, kLarge, kLargest };
enum class CaptionContrast {
  kNormal,
  kHigh  // bold white and yellow on opaque black, with an edge
};

struct CaptionStyle {
  CaptionSize size = CaptionSize::kNormal;
  CaptionContrast contrast = CaptionContrast::kNormal;

  bool is_high() const { return contrast == CaptionContrast::kHigh; }
  friend bool operator==(const CaptionStyle&, const CaptionStyle&) = default;
};

// Names in options, files and messages, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> kCaptionSizes = {"normal", "large", "largest"};
inline constexpr std::array<std::string_view, 2> kCaptionContrasts = {"normal", "high"};

// The enumerator of a name; nullopt: unknown name.
template <typename Choice, size_t n>
std::optional<Choice> ChoiceOf(const std::array<std::string_view, n>& names,
                               std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt
                              : std::optional(static_cast<Choice>(found - names.begin()));
}

template <typename Choice, size_t n>
std::string_view NameOf(const std::array<std::string_view, n>& names, Choice choice) {
  return names[static_cast<size_t>(choice)];
}

// Factor on the normal size of letters.
constexpr float ScaleOf(CaptionSize size) {
  constexpr std::array<float, 3> kScales = {1.0f, 1.5f, 2.0f};
  return kScales[static_cast<size_t>(size)];
}

}  // namespace lararium::render
