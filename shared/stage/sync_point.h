#pragma once

#include <cstdint>

namespace lararium::stage {

// Progress of an action of an actor, by the synchronisation points of the Behavior Markup Language
// 1.0 (section 4.2). The stroke is the essential part, such as the moment of taking.
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
