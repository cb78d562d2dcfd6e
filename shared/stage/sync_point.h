#pragma once

#include <cstdint>

namespace lararium::stage {

// How far something that somebody does has come (Behavior Markup Language 1.0, section
// 4.2): the stroke is the part of it that matters, such as the moment of taking.
enum class SyncPoint : uint8_t {
  kStart,
  kReady,
  kStrokeStart,
  kStroke,
  kStrokeEnd,
  kRelax,
  kEnd,
};
inline constexpr int kSyncPoints = 7;

}  // namespace lararium::stage
