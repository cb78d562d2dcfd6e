#pragma once

// The corners of a drawn occluder over an image with picks: a training image, or the camera's
// picture.

#include <imgui.h>

#include <optional>
#include <string>

#include "editor/panels/viewport/image_view.h"
#include "editor/session/workspace.h"
#include "shared/render/gl/texture.h"

namespace lararium::panels {

// Draws the corners that were picked in this image, the edges between them, and rings at the
// projections of located corners.
void DrawOccluderCorners(const editor::Workspace& workspace,
                         const editor::OccluderDocument& occluder,
                         const vision::Keyframe& keyframe,
                         const ImageView& map,
                         ImDrawList& draw);

// Draws a magnifier beside the pointer, for picking a single pixel. pixel: of the texture.
void DrawLoupe(const ImVec2& pointer,
               const Eigen::Vector2d& pixel,
               const render::Texture& texture,
               ImDrawList& draw);

// The next step, or how well the corners agree.
std::string CornerHint(const editor::Workspace& workspace,
                       const editor::OccluderDocument& occluder);

// Picks corners with the pointer.
class CornerDrag {
 public:
  // Call while the pointer is over the image. Draws beside the pointer what the next click does.
  void Update(editor::Workspace& workspace,
              const editor::OccluderDocument& occluder,
              const vision::Keyframe& keyframe,
              const ImageView& map,
              ImDrawList& draw);
  // Call when the button is released, even when the pointer is elsewhere.
  void EndDrag(editor::Workspace& workspace);

 private:
  std::optional<size_t> dragged_corner_;
};

}  // namespace lararium::panels
