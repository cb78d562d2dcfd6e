#pragma once

// The look of the interface: dark, calm, one accent.

#include <imgui.h>

#include "shared/core/status.h"

namespace lararium::panels {

struct Fonts {
  ImFont* regular = nullptr;
  ImFont* strong = nullptr;  // headings
  ImFont* title = nullptr;   // of a page
  ImFont* code = nullptr;    // letters of one width
};

// Sets colours, spacing and fonts of the current ImGui context for a display of
// that scale. Falls back to the built-in font where Inter or DejaVu is not installed.
void ApplyTheme(float scale);
const Fonts& ThemeFonts();

// Logical pixels (at scale 1) in those of the screen.
float Px(float logical);

namespace colour {

inline const ImVec4 kAccent = {0.851f, 0.420f, 0.286f, 1.0f};
inline const ImVec4 kText = {0.890f, 0.898f, 0.914f, 1.0f};
inline const ImVec4 kDim = {0.604f, 0.627f, 0.663f, 1.0f};
inline const ImVec4 kWarning = {0.918f, 0.749f, 0.373f, 1.0f};
inline const ImVec4 kError = {0.949f, 0.471f, 0.443f, 1.0f};
inline const ImVec4 kWindow = {0.098f, 0.106f, 0.122f, 1.0f};
inline const ImVec4 kPanel = {0.129f, 0.141f, 0.161f, 1.0f};
inline const ImVec4 kFrame = {0.180f, 0.196f, 0.224f, 1.0f};
inline const ImVec4 kHover = {0.231f, 0.251f, 0.286f, 1.0f};
inline const ImVec4 kLine = {0.200f, 0.216f, 0.247f, 1.0f};

// Words of scripts.
inline const ImVec4 kKeyword = {0.780f, 0.573f, 0.918f, 1.0f};
inline const ImVec4 kString = {0.647f, 0.816f, 0.529f, 1.0f};
inline const ImVec4 kNumber = {0.961f, 0.706f, 0.463f, 1.0f};
inline const ImVec4 kCall = {0.451f, 0.749f, 0.945f, 1.0f};

// X, Y, Z.
inline const ImVec4 kAxes[3] = {
    {0.878f, 0.365f, 0.365f, 1.0f}, {0.482f, 0.757f, 0.388f, 1.0f}, {0.369f, 0.592f, 0.918f, 1.0f}};

}  // namespace colour

inline ImU32 Packed(ImVec4 colour, float alpha = 1.0f) {
  colour.w *= alpha;
  return ImGui::ColorConvertFloat4ToU32(colour);
}

}  // namespace lararium::panels
