#pragma once

// The look of the interface: calm, one accent, dark or light.

#include <imgui.h>

#include "editor/panels/palette.h"

namespace lararium::panels {

struct Fonts {
  ImFont* regular = nullptr;
  ImFont* strong = nullptr;  // headings
  ImFont* title = nullptr;   // of a page
  ImFont* code = nullptr;    // letters of one width
};

// Sizes at scale 1, pixels.
inline constexpr float kTextPx = 15.5f;
inline constexpr float kCodePx = 15.0f;
inline constexpr float kTitlePx = 30.0f;
inline constexpr float kIconPx = 16.0f;

// Sets colours, spacing and fonts of the current ImGui context. scale: of the display and of
// the interface together. Not within a frame; the back end's font texture must be made anew.
// Falls back to the built-in font where Inter or DejaVu is not installed.
void ApplyTheme(Theme theme, float scale);
const Fonts& ThemeFonts();

// Logical pixels (at scale 1) in those of the screen.
float Px(float logical);

// Of the theme in use.
const Palette& Colours();

inline ImU32 Packed(ImVec4 colour, float alpha = 1.0f) {
  colour.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(colour);
}

}  // namespace lararium::panels
