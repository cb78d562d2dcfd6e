#pragma once

// The corners of an occluder that is drawn, over an image that they are picked in: a training
// image, or the camera's picture.

#include <imgui.h>

#include <optional>
#include <string>

#include "editor/app/workspace.h"
#include "editor/panels/image_map.h"
#include "shared/render/texture.h"

namespace lararium::panels {

// The corners that were picked in this image, with the edges between them, and rings where those
// that are located project to.
void DrawCorners(const app::Workspace& workspace,
                 const app::OccluderDocument& occluder,
                 const vision::Keyframe& keyframe,
                 const ImageMap& map,
                 ImDrawList& draw);

// A magnifier beside the pointer, so that a single pixel can be aimed at. pixel: of the texture.
void DrawLoupe(const ImVec2& pointer,
               const Eigen::Vector2d& pixel,
               const render::Texture& texture,
               ImDrawList& draw);

// What to do next, or how well the corners agree.
std::string CornerHint(const app::Workspace& workspace, const app::OccluderDocument& occluder);

// Picks by the pointer.
class CornerDrag {
 public:
  // While the pointer is over the image. What the next click does is written beside it.
  void Update(app::Workspace& workspace,
              const app::OccluderDocument& occluder,
              const vision::Keyframe& keyframe,
              const ImageMap& map,
              ImDrawList& draw);
  // Wherever the pointer is.
  void EndDrag(app::Workspace& workspace);

 private:
  std::optional<size_t> dragged_corner_;
};

}  // namespace lararium::panels
