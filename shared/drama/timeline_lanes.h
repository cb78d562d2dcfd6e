#pragma once

// The kinds of lanes of a timeline.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shared/core/ease.h"

namespace lararium::drama {

enum class LaneKind : uint8_t {
  kClips,     // Clips of the whole body along paths; the actor is led by the track.
  kGestures,  // Clips that play once on a part of the body.
  kSpeech,
  kWalks,
  kUses,  // Using, taking, putting and giving objects, and sitting.
  kGaze,
  kExpressions,
  kLights,
  kSounds,
  kCaptions,
  kDescriptions,
  kMarkers,
};
inline constexpr int kLaneKinds = 12;

struct LaneName {
  LaneKind kind;
  std::string_view name;  // Name of the field of track{...}.
  bool of_actor;
};
inline constexpr std::array<LaneName, kLaneKinds> kLaneNames = {{
    {LaneKind::kClips, "clips", true},
    {LaneKind::kGestures, "gestures", true},
    {LaneKind::kSpeech, "speech", true},
    {LaneKind::kWalks, "walks", true},
    {LaneKind::kUses, "uses", true},
    {LaneKind::kGaze, "gaze", true},
    {LaneKind::kExpressions, "expressions", true},
    {LaneKind::kLights, "lights", false},
    {LaneKind::kSounds, "sounds", false},
    {LaneKind::kCaptions, "captions", false},
    {LaneKind::kDescriptions, "descriptions", false},
    {LaneKind::kMarkers, "markers", false},
}};

inline std::optional<LaneKind> LaneNamed(std::string_view name) {
  for (const LaneName& lane : kLaneNames) {
    if (lane.name == name) {
      return lane.kind;
    }
  }
  return std::nullopt;
}
inline std::string_view NameOf(LaneKind kind) { return kLaneNames[static_cast<size_t>(kind)].name; }
inline bool IsOfActor(LaneKind kind) { return kLaneNames[static_cast<size_t>(kind)].of_actor; }

}  // namespace lararium::drama
