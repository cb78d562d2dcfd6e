#include "editor/panels/viewport/picture_textures.h"

#include <algorithm>

#include "editor/panels/widgets/frame_damage.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

ImTextureID ShownTexture(const render::Texture& texture) {
  return TextureOf(texture.id(), texture.version());
}

ImTextureID PictureTextures::Show(const std::string& key,
                                  const std::shared_ptr<const cv::Mat>& picture) {
  Entry& entry = entries_[key];
  if (entry.uploaded != picture) {
    entry.texture.Upload(*picture);
    entry.uploaded = picture;
  }
  return ShownTexture(entry.texture);
}

PictureRect FitPicture(const ImVec2& origin, const ImVec2& available, int width, int height) {
  const float scale =
      std::min(available.x / static_cast<float>(width), available.y / static_cast<float>(height));
  const ImVec2 size(static_cast<float>(width) * scale, static_cast<float>(height) * scale);
  return {
      ImVec2(origin.x + 0.5f * (available.x - size.x), origin.y + 0.5f * (available.y - size.y)),
      size};
}

void DrawThumbnail(PictureTextures& textures,
                   const std::string& key,
                   const std::shared_ptr<const cv::Mat>& picture,
                   float side,
                   ThumbnailOf what) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 to(from.x + side, from.y + side);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding;
  if (picture != nullptr) {
    draw.AddImageRounded(textures.Show(key, picture), from, to, ImVec2(0, 0), ImVec2(1, 1),
                         IM_COL32_WHITE, rounding);
  } else if (what == ThumbnailOf::kThing) {
    draw.AddRectFilled(from, to, Packed(Colours().frame), rounding);
  } else {
    // A silhouette of head and shoulders until there is a picture.
    const ImU32 ink = Packed(Colours().dim, 0.35f);
    draw.AddRectFilled(from, to, Packed(Colours().frame), rounding);
    draw.AddCircleFilled(ImVec2(from.x + 0.5f * side, from.y + 0.4f * side), 0.17f * side, ink);
    draw.PushClipRect(from, to, true);
    draw.AddCircleFilled(ImVec2(from.x + 0.5f * side, from.y + 0.98f * side), 0.33f * side, ink);
    draw.PopClipRect();
  }
  ImGui::Dummy(ImVec2(side, side));
}

}  // namespace lararium::panels
