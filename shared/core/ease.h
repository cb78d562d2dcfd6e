#pragma once

// Easing functions.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace lararium {

enum class Ease : uint8_t { kLinear, kIn, kOut, kSmooth };
inline constexpr std::array<std::string_view, 4> kEaseNames = {"linear", "in", "out", "smooth"};

inline std::optional<Ease> EaseNamed(std::string_view name) {
  for (size_t i = 0; i < kEaseNames.size(); ++i) {
    if (kEaseNames[i] == name) {
      return static_cast<Ease>(i);
    }
  }
  return std::nullopt;
}

// Returns the share of the change at a share of the time, 0..1: slow at the beginning, at the end,
// or at both (the cubic smoothstep).
inline double Eased(Ease ease, double t) {
  switch (ease) {
    case Ease::kIn:
      return t * t;
    case Ease::kOut:
      return t * (2.0 - t);
    case Ease::kSmooth:
      return t * t * (3.0 - 2.0 * t);
    default:
      return t;
  }
}

}  // namespace lararium
