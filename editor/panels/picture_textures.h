#pragma once

// Pictures that panels show again and again, on the GPU.

#include <imgui.h>

#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "shared/render/texture.h"

namespace lararium::panels {

// For ImGui's images.
ImTextureID ShownTexture(const render::Texture& texture);

class PictureTextures {
 public:
  // The texture that shows the picture (bgr, not empty); uploads where it is another than
  // the key's last. Needs the window's OpenGL context.
  ImTextureID Show(const std::string& key, const std::shared_ptr<const cv::Mat>& picture);

 private:
  struct Entry {
    render::Texture texture;
    std::shared_ptr<const cv::Mat> uploaded;
  };
  std::map<std::string, Entry> entries_;
};

enum class ThumbnailOf { kPerson, kThing };

// The picture over the next square of side pixels, cut out with round corners; an empty
// frame where there is none, with an outline of a person. Advances the cursor like an item.
void ShowThumbnail(PictureTextures& textures,
                   const std::string& key,
                   const std::shared_ptr<const cv::Mat>& picture,
                   float side,
                   ThumbnailOf what = ThumbnailOf::kPerson);

}  // namespace lararium::panels
