#include "editor/panels/widgets/frame_cover.h"

#include <array>

namespace lararium::panels {
namespace {

constexpr unsigned kOfRectangle = 6;  // Indices of a rectangle.

bool Holds(const DamageRect& outer, const DamageRect& inner) {
  return Intersection(outer, inner) == inner;
}

bool IsPlain(const ImDrawVert& corner, ImU32 colour, const ImVec2& white) {
  return corner.col == colour && corner.uv.x == white.x && corner.uv.y == white.y;
}

// Recognises the vertices that ImDrawList::PrimRect writes: upper left, upper right, lower right;
// upper left, lower right, lower left.
std::optional<DamageRect> OpaqueRect(const std::array<ImDrawVert, kOfRectangle>& v,
                                     const ImVec2& white) {
  const ImU32 colour = v[0].col;
  if ((colour & IM_COL32_A_MASK) != IM_COL32_A_MASK) {
    return std::nullopt;
  }
  for (const ImDrawVert& corner : v) {
    if (!IsPlain(corner, colour, white)) {
      return std::nullopt;
    }
  }
  const ImVec2& from = v[0].pos;
  const ImVec2& to = v[2].pos;
  const auto is_at = [&](size_t corner, float x, float y) {
    return v[corner].pos.x == x && v[corner].pos.y == y;
  };
  if (is_at(1, to.x, from.y) && is_at(3, from.x, from.y) && is_at(4, to.x, to.y) &&
      is_at(5, from.x, to.y)) {
    return DamageRect{from.x, from.y, to.x, to.y};
  }
  return std::nullopt;
}

}  // namespace

std::optional<FrameCover> FindCover(const ImDrawData& frame,
                                    const DamageRect& rect,
                                    ImTextureID font,
                                    const ImVec2& white) {
  for (int i = frame.CmdListsCount; i-- > 0;) {
    const ImDrawList& list = *frame.CmdLists[i];
    for (int k = list.CmdBuffer.Size; k-- > 0;) {
      const ImDrawCmd& command = list.CmdBuffer[k];
      const ImVec4& clip = command.ClipRect;
      if (command.UserCallback != nullptr || command.TextureId != font ||
          !Holds({clip.x, clip.y, clip.z, clip.w}, rect)) {
        continue;
      }
      for (unsigned end = command.ElemCount; end >= kOfRectangle; end -= 3) {
        std::array<ImDrawVert, kOfRectangle> corners;
        for (unsigned c = 0; c < kOfRectangle; ++c) {
          const auto at = static_cast<int>(command.IdxOffset + end - kOfRectangle + c);
          corners[c] = list.VtxBuffer[static_cast<int>(command.VtxOffset) + list.IdxBuffer[at]];
        }
        const std::optional<DamageRect> covered = OpaqueRect(corners, white);
        if (covered && Holds(*covered, rect)) {
          return FrameCover{corners[0].col, i, k, end};
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace lararium::panels
