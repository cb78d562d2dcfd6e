#pragma once

// The colours of the interface, dark and light. Text keeps a contrast of at least 4.5 to 1 on
// whatever lies below it (WCAG 2, level AA), and colours that tell states apart do so for people
// who see no red or no green; tests hold both palettes to that.

#include <imgui.h>

#include <cstdint>

#include "editor/app/settings.h"
#include "shared/drama/timeline_lanes.h"

namespace lararium::panels {

using app::Theme;

// sRGB, opaque.
struct Palette {
  ImVec4 accent;  // lines, ticks and marks; no ground for text
  ImVec4 chosen;  // below the text of what is chosen, or of the button that matters most
  ImVec4 text;
  ImVec4 dim;  // text that matters less
  ImVec4 good;
  ImVec4 warning;
  ImVec4 error;
  ImVec4 window;  // behind and between the panels
  ImVec4 panel;
  ImVec4 frame;  // fields and buttons
  ImVec4 hover;
  ImVec4 line;

  // Words of scripts.
  ImVec4 keyword;
  ImVec4 string;
  ImVec4 number;
  ImVec4 call;
};

const Palette& PaletteOf(Theme theme);

// Of what lies over photographs and in the view around the place, in either theme.
inline const Palette& OverPicture() { return PaletteOf(Theme::kDark); }

// X, Y, Z: beside their letters, since not everybody tells red from green.
inline const ImVec4 kAxisColours[3] = {
    {0.878f, 0.365f, 0.365f, 1.0f}, {0.482f, 0.757f, 0.388f, 1.0f}, {0.369f, 0.592f, 0.918f, 1.0f}};

// Of a training session, in the view around the place: told apart by people who see colours
// differently, too (after Okabe & Ito, Color Universal Design, 2002). They come again after the
// eighth.
ImVec4 SessionColour(uint32_t session);
inline constexpr uint32_t kSessionColours = 8;
// Of a person of the cast, where something of theirs is drawn over a picture; the same set.
inline ImVec4 PersonColour(uint32_t cast) { return SessionColour(cast); }
// Of a kind of item on the timeline (likewise, calmed), beside its icon. Kinds of the stage share
// those of people.
ImVec4 LaneColour(drama::LaneKind kind);
// Of what several sessions saw.
inline const ImVec4 kSeveralColour = {0.86f, 0.87f, 0.89f, 1.0f};

// From little (0) to much (1), clamped: blue over grey to yellow, ever lighter, so that it reads
// without telling hues apart.
ImVec4 RampColour(double t);

// How a colour that lets some of the ground through looks on it. front.w: how opaque it is.
ImVec4 Over(const ImVec4& front, const ImVec4& ground);

// WCAG 2: relative luminance, 0 to 1, and contrast ratio, 1 to 21, of opaque colours.
double Luminance(const ImVec4& colour);
double Contrast(const ImVec4& a, const ImVec4& b);

// Black or white, whichever reads better on a colour.
ImVec4 InkOn(const ImVec4& ground);

// How strongly the accent tints rows below text.
inline constexpr float kSelectedTint = 0.30f;
inline constexpr float kPressedTint = 0.40f;
inline constexpr float kErrorTint = 0.13f;

inline ImVec4 WithAlpha(ImVec4 colour, float alpha) {
  colour.w = alpha;
  return colour;
}

}  // namespace lararium::panels
