#pragma once

// The occluders of a place over the camera's picture, as shaded translucent solids.

#include <imgui.h>

#include <memory>
#include <vector>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/ghost.h"
#include "editor/panels/view_camera.h"

namespace lararium::panels {

class GhostView {
 public:
  // All of them where they are switched on, otherwise the selected one alone.
  void Show(const app::Workspace& workspace,
            const EditorState& state,
            const ViewCamera& view,
            ImDrawList& draw);

 private:
  // Models of many faces are made coarser: they are drawn by the processor.
  void Update(const app::Workspace& workspace);

  std::shared_ptr<const stage::Place> staged_;  // whose occluders the ghosts are
  std::vector<Ghost> ghosts_;
  std::vector<GhostFace> faces_;  // kept for their memory
};

}  // namespace lararium::panels
