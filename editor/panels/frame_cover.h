#pragma once

// What of a frame need not be drawn, because something opaque lies over it.

#include <imgui.h>

#include <optional>

#include "editor/panels/frame_damage.h"

namespace lararium::panels {

// A rectangle of one colour that hides all that ImGui draws before it.
struct FrameCover {
  ImU32 colour = 0;
  int list = 0;           // of the frame's draw lists
  int command = 0;        // of the list's
  unsigned elements = 0;  // of the command's, with the rectangle itself
};

// The last that covers all of rect; none where nothing does. white: where ImGui's texture of
// letters, font, is white (ImGui::GetFontTexUvWhitePixel).
std::optional<FrameCover> FindCover(const ImDrawData& frame,
                                    const DamageRect& rect,
                                    ImTextureID font,
                                    const ImVec2& white);

}  // namespace lararium::panels
