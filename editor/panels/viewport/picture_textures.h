#pragma once

// Textures of pictures that panels show in many frames.

#include <imgui.h>

#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "shared/render/gl/texture.h"

namespace lararium::panels {

// For ImGui's images.
ImTextureID ShownTexture(const render::Texture& texture);

class PictureTextures {
 public:
  // The texture of a picture (bgr, not empty). Uploads it where the key's last picture was another
  // one. Needs the window's OpenGL context.
  ImTextureID Show(const std::string& key, const std::shared_ptr<const cv::Mat>& picture);

 private:
  struct Entry {
    render::Texture texture;
    std::shared_ptr<const cv::Mat> uploaded;
  };
  std::map<std::string, Entry> entries_;
};

struct PictureRect {
  ImVec2 origin;
  ImVec2 size;

  ImVec2 corner() const { return {origin.x + size.x, origin.y + size.y}; }
};
// The largest rectangle with a picture's aspect ratio in the middle of the available space.
PictureRect FitPicture(const ImVec2& origin, const ImVec2& available, int width, int height);

enum class ThumbnailOf { kPerson, kThing };

// Draws the picture in a square with round corners, side pixels wide. Without a picture: an empty
// frame with the outline of a person. Advances the cursor like an item.
void DrawThumbnail(PictureTextures& textures,
                   const std::string& key,
                   const std::shared_ptr<const cv::Mat>& picture,
                   float side,
                   ThumbnailOf what = ThumbnailOf::kPerson);

}  // namespace lararium::panels
