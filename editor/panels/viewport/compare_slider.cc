#include "editor/panels/viewport/compare_slider.h"

#include <algorithm>
#include <cmath>

#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

namespace {

// The line with a grip in the middle.
void DrawHandle(float x, const ImVec2& origin, const ImVec2& size, bool lit, ImDrawList& draw) {
  const ImU32 colour = Packed(lit ? OverPicture().accent : OverPicture().text);
  draw.AddLine(ImVec2(x, origin.y), ImVec2(x, origin.y + size.y), colour, Px(2));
  const ImVec2 middle(x, origin.y + 0.5f * size.y);
  const ImVec2 half(Px(7), Px(18));
  const ImVec2 low(middle.x - half.x, middle.y - half.y);
  const ImVec2 high(middle.x + half.x, middle.y + half.y);
  draw.AddRectFilled(low, high, Packed(OverPicture().window), Px(4));
  draw.AddRect(low, high, colour, Px(4), 0, Px(1.5f));
  for (const float side : {-Px(2), Px(2)}) {
    draw.AddLine(ImVec2(middle.x + side, middle.y - Px(6)),
                 ImVec2(middle.x + side, middle.y + Px(6)), colour, Px(1.5f));
  }
}

}  // namespace

bool CompareSlider::Show(bool shown,
                         const editor::PreviewPicture& picture,
                         const ImVec2& origin,
                         const ImVec2& size,
                         bool hovered,
                         ImDrawList& draw) {
  dragged_ = dragged_ && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (!shown || picture.plain.empty()) {
    return false;
  }
  if (uploaded_ != &picture) {
    plain_.Upload(picture.plain);
    uploaded_ = &picture;
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool near = hovered && std::abs(mouse.x - (origin.x + at_ * size.x)) < Px(8);
  dragged_ = dragged_ || (near && ImGui::IsMouseClicked(ImGuiMouseButton_Left));
  if (dragged_) {
    at_ = std::clamp((mouse.x - origin.x) / size.x, 0.0f, 1.0f);
  }
  if (near || dragged_) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  }
  const float x = origin.x + at_ * size.x;
  // Draws the whole image, clipped, so that its pixels match those of the picture.
  draw.PushClipRect(origin, ImVec2(x, origin.y + size.y), true);
  draw.AddImage(ShownTexture(plain_), origin, ImVec2(origin.x + size.x, origin.y + size.y));
  draw.PopClipRect();
  DrawHandle(x, origin, size, near || dragged_, draw);
  const float y = origin.y + size.y - Px(30);
  const float before = std::max(Px(70), ImGui::CalcTextSize(Tr("Before")).x + Px(14));
  DrawLabel(ImVec2(std::max(x - before, origin.x + Px(8)), y), Tr("Before"),
            Packed(OverPicture().text), draw);
  DrawLabel(ImVec2(x + Px(14), y), Tr("After"), Packed(OverPicture().text), draw);
  return near || dragged_;
}

}  // namespace lararium::panels
