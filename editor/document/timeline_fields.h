#pragma once

// Reading the fields of timeline items.

#include <string>
#include <string_view>

#include "shared/core/json.h"
#include "shared/drama/timeline_lanes.h"

namespace lararium::editor {

// The field as a string; "" where it is missing or not a string.
inline std::string TextOf(const Json& fields, std::string_view key) {
  const auto found = fields.find(key);
  return found != fields.end() && found->is_string() ? found->get<std::string>() : "";
}

// The texts that label an item of a lane, joined by spaces.
inline std::string LabelTexts(const drama::LaneSpec& lane, const Json& fields) {
  if (lane.label.empty()) {
    return TextOf(fields, lane.content);
  }
  std::string label;
  for (const std::string_view key : lane.label) {
    const std::string text = TextOf(fields, key);
    label += (label.empty() || text.empty() ? "" : " ") + text;
  }
  return label;
}

}  // namespace lararium::editor
