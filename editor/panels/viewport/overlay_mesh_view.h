#pragma once

// The occluders of a place over the camera's picture, as shaded translucent solids.

#include <imgui.h>

#include <memory>
#include <vector>

#include "editor/panels/viewport/overlay_mesh.h"
#include "editor/panels/viewport/view_camera.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

class OverlayMeshView {
 public:
  // Shows all occluders if they are switched on, otherwise only the selected one.
  void Show(const editor::Workspace& workspace,
            const Selection& selection,
            const ViewOptions& options,
            const ViewCamera& view,
            ImDrawList& draw);

 private:
  // Simplifies models with many faces, because the CPU draws them.
  void Update(const editor::Workspace& workspace);

  std::shared_ptr<const stage::Place> staged_;  // The place whose occluders are in overlays_.
  std::vector<OverlayMesh> overlays_;
  std::vector<OverlayFace> faces_;  // Kept to reuse its memory.
};

}  // namespace lararium::panels
