#pragma once

// Constants that convert between the units of the code (metres, radians) and those that people
// type and read.

#include <numbers>

namespace lararium {

inline constexpr double kPi = std::numbers::pi;
inline constexpr float kPiF = std::numbers::pi_v<float>;
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
inline constexpr float kRadiansPerDegreeF = kPiF / 180.0f;
inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
inline constexpr double kCentimetresPerMetre = 100.0;

}  // namespace lararium
