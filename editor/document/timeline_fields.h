#pragma once

// Reading the fields of timeline items, and choosing the lane for an action.

#include <string>
#include <string_view>
#include <utility>

#include "shared/core/json.h"
#include "shared/drama/timeline_lanes.h"

namespace lararium::editor {

// The field as a string; "" where it is missing or not a string.
inline std::string TextOf(const Json& fields, const char* key) {
  const auto found = fields.find(key);
  return found != fields.end() && found->is_string() ? found->get<std::string>() : "";
}

// The field that names what an item of this kind of lane shows or plays.
inline const char* NamingField(drama::LaneKind kind) {
  switch (kind) {
    case drama::LaneKind::kClips:
    case drama::LaneKind::kGestures:
    case drama::LaneKind::kWalks:
      return "clip";
    case drama::LaneKind::kSpeech:
    case drama::LaneKind::kCaptions:
    case drama::LaneKind::kDescriptions:
      return "line";
    case drama::LaneKind::kUses:
      return "object";
    case drama::LaneKind::kGaze:
      return "target";
    case drama::LaneKind::kExpressions:
      return "expression";
    case drama::LaneKind::kLights:
      return "light";
    case drama::LaneKind::kSounds:
      return "sound";
    case drama::LaneKind::kMarkers:
      return "name";
  }
  return "";
}

// The kind of lane for the result of a task's action ("walk_to", "say salvete").
inline drama::LaneKind LaneOfTask(std::string_view action) {
  using drama::LaneKind;
  constexpr std::pair<std::string_view, LaneKind> kKnown[] = {
      {"say", LaneKind::kSpeech},          {"walk_to", LaneKind::kWalks},
      {"turn_to", LaneKind::kWalks},       {"walk", LaneKind::kWalks},
      {"hide", LaneKind::kWalks},          {"play", LaneKind::kGestures},
      {"gesture", LaneKind::kGestures},    {"look_at", LaneKind::kGaze},
      {"express", LaneKind::kExpressions}, {"marker", LaneKind::kMarkers}};
  const std::string_view word = action.substr(0, action.find(' '));
  for (const auto& [name, lane] : kKnown) {
    if (word == name) {
      return lane;
    }
  }
  return LaneKind::kUses;
}

}  // namespace lararium::editor
