#pragma once

// The camera view: the recording, tracked and composited. The stage, the handles of the selection
// and overlay meshes of occluders are drawn over it.

#include <imgui.h>

#include "editor/panels/viewport/compare_slider.h"
#include "editor/panels/viewport/corner_view.h"
#include "editor/panels/viewport/light_view.h"
#include "editor/panels/viewport/overlay_mesh_view.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/panels/viewport/walk_view.h"
#include "editor/session/onion_skin.h"
#include "editor/session/workspace.h"
#include "shared/render/gl/texture.h"

namespace lararium::panels {

// The settings of the onion skin: number and spacing of the skins.
struct OnionSettings {
  editor::OnionSkin skin;
  bool asked = false;  // Opens the popup of the settings in the next frame.
};

class CameraView {
 public:
  // Fills the current window.
  void Show(const PanelContext& context);
  void OpenOnionSettings() { onion_.asked = true; }

 private:
  // Shows the corners of the drawn occluder that is selected, if there is one. origin, size: the
  // picture on the screen.
  void DrawCorners(editor::Workspace& workspace,
                   const Selection& selection,
                   const editor::PreviewPicture& picture,
                   const ImVec2& origin,
                   const ImVec2& size,
                   bool hovered,
                   ImDrawList& draw);

  render::Texture texture_;
  OverlayMeshView overlays_;
  WalkView walks_;
  CompareSlider compare_slider_;
  CornerDrag corners_;
  LightOverlay light_;
  OnionSettings onion_;
  const editor::PreviewPicture* uploaded_ = nullptr;
};

}  // namespace lararium::panels
