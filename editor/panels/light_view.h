#pragma once

// What belongs to the selected light probe over the camera's picture: the balls, picks on the
// stage, before and after, the histogram.

#include <imgui.h>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "shared/render/texture.h"

namespace lararium::panels {

class LightOverlay {
 public:
  // origin, size: of the picture on the screen. hovered: the pointer is over the view. Nothing
  // where no probe is selected.
  void Show(app::Workspace& workspace,
            EditorState& state,
            const app::PreviewPicture& picture,
            const ImVec2& origin,
            const ImVec2& size,
            bool hovered,
            ImDrawList& draw);

 private:
  enum class Drag { kNothing, kWipe, kBall };

  void ShowWipe(EditorState& state,
                const app::PreviewPicture& picture,
                const ImVec2& origin,
                const ImVec2& size,
                bool hovered,
                ImDrawList& draw);

  render::Texture plain_;
  const app::PreviewPicture* uploaded_ = nullptr;
  Drag drag_ = Drag::kNothing;
};

}  // namespace lararium::panels
