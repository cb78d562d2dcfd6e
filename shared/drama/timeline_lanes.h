#pragma once

// The kinds of items that a timeline holds.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace lararium::drama {

enum class LaneKind : uint8_t {
  kClips,     // the whole body follows clips along paths; nothing else moves it
  kGestures,  // a clip once, with a part of the body
  kSpeech,
  kWalks,
  kUses,  // of objects: also taking, putting, giving, sitting
  kGaze,
  kExpressions,
  kLights,
  kSounds,
  kCaptions,
  kMarkers,
};
inline constexpr int kLaneKinds = 11;

struct LaneName {
  LaneKind kind;
  std::string_view name;  // the field of track{...}
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

// How something goes from its beginning to its end over its length.
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

// The share of the way at a share of the time, 0..1: slow at the beginning, the end, or
// both (the cubic smoothstep).
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

}  // namespace lararium::drama
