#pragma once

// Drawing of the timeline.

#include <imgui.h>

#include <cstdint>
#include <span>
#include <string>

#include "editor/panels/timeline/timeline_maths.h"
#include "shared/drama/timeline_lanes.h"
#include "shared/human/face.h"

namespace lararium::panels {

// The title of a kind of lane, and of one of its items.
const char* LaneTitle(drama::LaneKind kind);
const char* ItemTitle(drama::LaneKind kind);

struct ItemLook {
  bool selected = false;
  bool hovered = false;
  bool scripted = false;  // A result of the script; drawn hatched.
  bool failed = false;
  bool open_end = false;  // The drama does not define its length.
};

// Draws an item in a rectangle of the screen. The label is cut off where it does not fit.
void DrawItem(ImDrawList& draw,
              const ImVec2& from,
              const ImVec2& to,
              const ImVec4& colour,
              const std::string& label,
              const ItemLook& look);

// Draws the sound of a line from the time begin on, and below it how far the mouth opens. Draws
// only the part within [from, to].
struct VoiceShape {
  std::span<const uint8_t> peaks;  // See StageWords::Line.
  double peaks_per_second = 100.0;
  std::span<const human::VisemeTrack::Key> visemes;
};
void DrawVoice(ImDrawList& draw,
               const TimeScale& scale,
               const VoiceShape& voice,
               double begin,
               const ImVec2& from,
               const ImVec2& to,
               ImU32 colour);

// The ruler over [scale.left, scale.left + scale.width], and the grid lines down to bottom.
void DrawRulerTicks(ImDrawList& draw, const TimeScale& scale, float top, float height);
void DrawGrid(ImDrawList& draw, const TimeScale& scale, float top, float bottom);
// The current time: a line, and a handle on the ruler.
void DrawPlayhead(ImDrawList& draw, float x, float top, float bottom);
void DrawPlayheadHandle(ImDrawList& draw, float x, float top, float height);

}  // namespace lararium::panels
