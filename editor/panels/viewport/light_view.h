#pragma once

// The overlay of the selected light probe on the camera's picture: the balls, picks on the stage,
// the histogram.

#include <imgui.h>

#include "editor/panels/inspector/light_panel.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

struct PanelContext;

class LightOverlay {
 public:
  // Whether it needs the camera's image alone in addition to the picture (PreviewLook::compare).
  static bool ComparesPictures(const editor::Workspace& workspace,
                               const Selection& selection,
                               const LightView& light);

  // origin, size: the picture on the screen. hovered: the pointer is over the view. Does nothing
  // where no probe is selected.
  void Show(const PanelContext& context,
            const editor::PreviewPicture& picture,
            const ImVec2& origin,
            const ImVec2& size,
            bool hovered,
            ImDrawList& draw);

 private:
  bool drags_ball_ = false;
};

}  // namespace lararium::panels
