#pragma once

// The fonts, colours and spacing of the interface, with one accent, dark or light.

#include <imgui.h>

#include "editor/panels/widgets/palette.h"

namespace lararium::panels {

struct Fonts {
  ImFont* regular = nullptr;
  ImFont* strong = nullptr;  // Headings.
  ImFont* title = nullptr;   // The title of a page.
  ImFont* code = nullptr;    // Monospaced.
};

// Sizes at scale 1, pixels.
inline constexpr float kTextPx = 15.5f;
inline constexpr float kCodePx = 15.0f;
inline constexpr float kTitlePx = 30.0f;
inline constexpr float kIconPx = 16.0f;

// Sets colours, spacing and fonts of the current ImGui context. scale: the display's scale times
// the interface's scale. Must not be called within a frame; the back end's font texture must be
// created again. Uses the built-in font where Inter or DejaVu is not installed.
void ApplyTheme(Theme theme, float scale);
const Fonts& ThemeFonts();

// Converts logical pixels (at scale 1) to screen pixels.
float Px(float logical);

// The palette of the current theme.
const Palette& Colours();

inline ImU32 Packed(ImVec4 colour, float alpha = 1.0f) {
  colour.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(colour);
}

}  // namespace lararium::panels
