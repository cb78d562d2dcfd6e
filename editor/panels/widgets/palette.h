#pragma once

// The colours of the interface, dark and light. Text has a contrast of at least 4.5 to 1 on every
// background (WCAG 2, level AA), and colours that distinguish states can be distinguished without
// red or green vision. Tests verify both for both palettes.

#include <imgui.h>

#include <cstdint>

#include "editor/session/settings.h"
#include "shared/drama/timeline_lanes.h"

namespace lararium::panels {

using editor::Theme;

// sRGB, opaque.
struct Palette {
  ImVec4 accent;  // Lines, ticks and marks; not a background of text.
  ImVec4 chosen;  // The background of selected text, or of the most important button.
  ImVec4 text;
  ImVec4 dim;  // Less important text.
  ImVec4 good;
  ImVec4 warning;
  ImVec4 error;
  ImVec4 window;  // Behind and between the panels.
  ImVec4 panel;
  ImVec4 frame;  // Fields and buttons.
  ImVec4 hover;
  ImVec4 line;

  // Syntax of scripts.
  ImVec4 keyword;
  ImVec4 string;
  ImVec4 number;
  ImVec4 call;
};

const Palette& PaletteOf(Theme theme);

// For drawing over photographs and in the scene view, in both themes.
inline const Palette& OverPicture() { return PaletteOf(Theme::kDark); }

// X, Y, Z. They are always shown with their letters, because some users cannot distinguish red and
// green.
inline const ImVec4 kAxisColours[3] = {
    {0.878f, 0.365f, 0.365f, 1.0f}, {0.482f, 0.757f, 0.388f, 1.0f}, {0.369f, 0.592f, 0.918f, 1.0f}};

// The colour of a training session in the scene view, for all types of colour vision (after Okabe &
// Ito, Color Universal Design, 2002). Colours repeat after the eighth.
ImVec4 SessionColour(uint32_t session);
inline constexpr uint32_t kSessionColours = 8;
// The colour of a cast member for drawings over a picture, from the same set.
inline ImVec4 PersonColour(uint32_t cast) { return SessionColour(cast); }
// The colour of a kind of timeline item, shown beside its icon; the same set with less saturation.
// Kinds of the stage share the colours of those of people.
ImVec4 LaneColour(drama::LaneKind kind);
// The colour of points that several sessions observed.
inline const ImVec4 kSeveralColour = {0.86f, 0.87f, 0.89f, 1.0f};

// A colour ramp from 0 to 1, clamped: from blue over grey to yellow with increasing lightness, so
// that it can be read without distinguishing hues.
ImVec4 RampColour(double t);

// A translucent colour composited over an opaque one. front.w: opacity.
ImVec4 Over(const ImVec4& front, const ImVec4& ground);

// WCAG 2: relative luminance, 0 to 1, and contrast ratio, 1 to 21, of opaque colours.
double Luminance(const ImVec4& colour);
double Contrast(const ImVec4& a, const ImVec4& b);

// Black or white, whichever has more contrast on a colour.
ImVec4 InkOn(const ImVec4& ground);

// The opacity of the accent in rows behind text.
inline constexpr float kSelectedTint = 0.30f;
inline constexpr float kPressedTint = 0.40f;
inline constexpr float kErrorTint = 0.13f;

inline ImVec4 WithAlpha(ImVec4 colour, float alpha) {
  colour.w = alpha;
  return colour;
}

}  // namespace lararium::panels
