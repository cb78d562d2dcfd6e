#pragma once

// How the timeline looks.

#include <imgui.h>

#include <cstdint>
#include <span>
#include <string>

#include "editor/panels/timeline_maths.h"
#include "shared/drama/timeline_lanes.h"
#include "shared/human/face.h"

namespace lararium::panels {

// What people call a kind of lane, and one of its items.
const char* LaneTitle(drama::LaneKind kind);
const char* ItemTitle(drama::LaneKind kind);

struct ItemLook {
  bool selected = false;
  bool hovered = false;
  bool scripted = false;  // what the script did: hatched
  bool failed = false;
  bool open_end = false;  // its length is not written
};

// One item in a rectangle of the screen. The label is cut off where it does not fit.
void DrawItem(ImDrawList& draw,
              const ImVec2& from,
              const ImVec2& to,
              const ImVec4& colour,
              const std::string& label,
              const ItemLook& look);

// The sound of a line over the time [begin, begin + peaks], and below it how the mouth opens.
// Only what lies within [from, to] is drawn.
struct VoiceShape {
  std::span<const uint8_t> peaks;  // StageWords::Line
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

// The ruler over [scale.left, + width], and light lines down to bottom.
void DrawRuler(ImDrawList& draw, const TimeScale& scale, float top, float height);
void DrawGrid(ImDrawList& draw, const TimeScale& scale, float top, float bottom);
// The moment that is seen: a line, and a handle on the ruler.
void DrawPlayhead(ImDrawList& draw, float x, float top, float bottom);
void DrawPlayheadHandle(ImDrawList& draw, float x, float top, float height);

}  // namespace lararium::panels
