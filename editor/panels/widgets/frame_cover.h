#pragma once

// Finds the part of a frame that need not be drawn because an opaque rectangle covers it.

#include <imgui.h>

#include <optional>

#include "editor/panels/widgets/frame_damage.h"

namespace lararium::panels {

// A rectangle of one colour that hides everything that ImGui draws before it.
struct FrameCover {
  ImU32 colour = 0;
  int list = 0;           // Index of the frame's draw list.
  int command = 0;        // Index of the list's command.
  unsigned elements = 0;  // Elements of the command up to and including the rectangle.
};

// The last rectangle that covers all of rect; nullopt where there is none. white: the white pixel
// of ImGui's font texture font (ImGui::GetFontTexUvWhitePixel).
std::optional<FrameCover> FindCover(const ImDrawData& frame,
                                    const DamageRect& rect,
                                    ImTextureID font,
                                    const ImVec2& white);

}  // namespace lararium::panels
