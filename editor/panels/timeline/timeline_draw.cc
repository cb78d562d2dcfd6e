#include "editor/panels/timeline/timeline_draw.h"

#include <algorithm>
#include <cmath>

#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

using drama::LaneKind;

namespace {

constexpr float kTextLine = 24.0f;  // Logical pixels; the label is in the upper part.
constexpr float kNarrow = 4.0f;     // Logical pixels; a narrower item is drawn as a plain bar.

ImVec4 Mixed(const ImVec4& a, const ImVec4& b, float t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, 1.0f};
}

// Lines from bottom left to top right, clipped at the sides.
void DrawHatch(ImDrawList& draw, const ImVec2& from, const ImVec2& to, ImU32 colour) {
  const float height = to.y - from.y;
  const float gap = Px(7);
  const float begin = std::floor((from.x - height) / gap) * gap;
  const int lines = static_cast<int>((to.x - begin) / gap) + 1;
  for (int i = 0; i < lines; ++i) {
    const float x = begin + static_cast<float>(i) * gap;
    const float x0 = std::max(x, from.x);
    const float x1 = std::min(x + height, to.x);
    if (x1 > x0) {
      draw.AddLine(ImVec2(x0, to.y - (x0 - x)), ImVec2(x1, to.y - (x1 - x)), colour, Px(1));
    }
  }
}

}  // namespace

const char* LaneTitle(LaneKind kind) { return Tr(drama::SpecOf(kind).title); }
const char* ItemTitle(LaneKind kind) { return Tr(drama::SpecOf(kind).item_title); }

void DrawItem(ImDrawList& draw,
              const ImVec2& from,
              const ImVec2& to,
              const ImVec4& colour,
              const std::string& label,
              const ItemLook& look) {
  ImVec4 fill =
      look.scripted ? Mixed(colour, Colours().panel, 0.72f) : Mixed(colour, Colours().panel, 0.18f);
  if (look.hovered || look.selected) {
    fill = Mixed(fill, Colours().text, 0.14f);
  }
  if (to.x - from.x < Px(kNarrow) && !look.selected) {
    draw.AddRectFilled(from, to, Packed(look.failed ? Colours().error : fill));
    return;
  }
  draw.AddRectFilled(from, to, Packed(fill), Px(3));
  if (look.scripted) {
    DrawHatch(draw, from, to, Packed(colour, 0.35f));
  }
  if (look.open_end && to.x - from.x > Px(12)) {
    // The drama does not define the end, so it is drawn faded.
    draw.AddRectFilled(ImVec2(to.x - Px(3), from.y), to, Packed(Colours().panel, 0.55f));
  }
  if (look.selected) {
    draw.AddRect(from, to, Packed(Colours().text), Px(3), 0, Px(2));
  } else if (look.failed) {
    draw.AddRect(from, to, Packed(Colours().error), Px(3), 0, Px(1.5f));
  }
  const float text_left = from.x + Px(6);
  if (!label.empty() && to.x - text_left > Px(12)) {
    const float y = from.y + Px(0.5f * (kTextLine - 4)) - 0.5f * ImGui::GetTextLineHeight();
    const ImVec4 clip(from.x, from.y, to.x - Px(3), to.y);
    draw.AddText(nullptr, 0.0f, ImVec2(text_left, y), Packed(InkOn(fill)), label.c_str(), nullptr,
                 0.0f, &clip);
  }
}

// How far a viseme opens the mouth, 0..1.
float Opening(human::Viseme viseme) {
  switch (viseme) {
    case human::Viseme::kAa:
      return 1.0f;
    case human::Viseme::kE:
    case human::Viseme::kOh:
      return 0.75f;
    case human::Viseme::kIh:
    case human::Viseme::kOu:
      return 0.55f;
    case human::Viseme::kSil:
    case human::Viseme::kPP:
      return 0.0f;
    default:
      return 0.3f;
  }
}

void DrawVoice(ImDrawList& draw,
               const TimeScale& scale,
               const VoiceShape& voice,
               double begin,
               const ImVec2& from,
               const ImVec2& to,
               ImU32 colour) {
  const float bottom = to.y - Px(1);
  const float mouth = Px(5);  // Height of the lower part.
  const float middle = 0.5f * (from.y + bottom - mouth);
  const float half = 0.5f * (bottom - mouth - from.y);
  for (float x = std::max(std::ceil(from.x), scale.left); x < to.x; x += 1.0f) {
    const double t0 = (scale.TimeAt(x) - begin) * voice.peaks_per_second;
    const double t1 = (scale.TimeAt(x + 1.0f) - begin) * voice.peaks_per_second;
    if (t0 < 0.0) {
      continue;
    }
    const auto first = static_cast<size_t>(t0);
    const size_t last = std::max(static_cast<size_t>(std::max(t1, 0.0)), first + 1);
    if (first >= voice.peaks.size()) {
      break;
    }
    uint8_t peak = 0;
    for (size_t i = first; i < std::min(last, voice.peaks.size()); ++i) {
      peak = std::max(peak, voice.peaks[i]);
    }
    // Voices are far below full scale, so the square root is drawn.
    const float height = std::max(half * std::sqrt(static_cast<float>(peak) / 255.0f), 0.5f);
    draw.AddRectFilled(ImVec2(x, middle - height), ImVec2(x + 1.0f, middle + height), colour);
  }
  for (size_t i = 0; i < voice.visemes.size(); ++i) {
    const float x0 = std::max(scale.XOf(begin + voice.visemes[i].time), from.x);
    const float x1 = i + 1 < voice.visemes.size()
                         ? std::min(scale.XOf(begin + voice.visemes[i + 1].time), to.x)
                         : x0;
    const float open = Opening(voice.visemes[i].viseme) * voice.visemes[i].strength;
    if (x1 > x0 && open > 0.0f) {
      draw.AddRectFilled(ImVec2(x0, bottom - mouth * open), ImVec2(std::max(x1, x0 + 1.0f), bottom),
                         colour);
    }
  }
}

void DrawRulerTicks(ImDrawList& draw, const TimeScale& scale, float top, float height) {
  const RulerStep step = ChooseStep(scale.seconds_per_px, Px(76));
  const double minor = step.seconds / step.parts;
  const auto first = static_cast<int64_t>(std::floor(scale.first / minor));
  const auto last = static_cast<int64_t>(std::ceil(scale.last() / minor));
  for (int64_t i = first; i <= last; ++i) {
    const double seconds = static_cast<double>(i) * minor;
    const float x = std::round(scale.XOf(seconds));
    if (x < scale.left) {
      continue;
    }
    const bool major = i % step.parts == 0;
    draw.AddLine(ImVec2(x, top + height - Px(major ? 8 : 4)), ImVec2(x, top + height),
                 Packed(Colours().dim, major ? 0.9f : 0.45f));
    const std::string time = FormatTime(seconds, step.seconds);
    if (major && x + Px(4) + ImGui::CalcTextSize(time.c_str()).x <= scale.left + scale.width) {
      draw.AddText(ImVec2(x + Px(4), top + Px(2)), Packed(Colours().dim), time.c_str());
    }
  }
}

void DrawGrid(ImDrawList& draw, const TimeScale& scale, float top, float bottom) {
  const RulerStep step = ChooseStep(scale.seconds_per_px, Px(76));
  const auto last = static_cast<int64_t>(std::ceil(scale.last() / step.seconds));
  for (auto i = static_cast<int64_t>(std::floor(scale.first / step.seconds)); i <= last; ++i) {
    const float x = std::round(scale.XOf(static_cast<double>(i) * step.seconds));
    if (x >= scale.left) {
      draw.AddLine(ImVec2(x, top), ImVec2(x, bottom), Packed(Colours().line, 0.7f));
    }
  }
}

void DrawPlayhead(ImDrawList& draw, float x, float top, float bottom) {
  draw.AddLine(ImVec2(x, top), ImVec2(x, bottom), Packed(Colours().accent), Px(1.5f));
}

void DrawPlayheadHandle(ImDrawList& draw, float x, float top, float height) {
  const float half = Px(6);
  draw.AddTriangleFilled(ImVec2(x - half, top + height - Px(10)),
                         ImVec2(x + half, top + height - Px(10)), ImVec2(x, top + height),
                         Packed(Colours().accent));
}

}  // namespace lararium::panels
