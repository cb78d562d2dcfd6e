#pragma once

#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/input.h"
#include "editor/session/cast_pictures.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The view of the selected person.
struct CastView {
  int frame = 0;         // Head and shoulders, face, or figure.
  float azimuth = 0.0f;  // Radians; see StudioView.
  std::string search;    // The text to find among the features.
  std::string joint;     // Joint of an imported figure that is highlighted in its portrait.
  bool all_joints = false;
  std::shared_ptr<const editor::CastPortrait> portrait;  // The portrait of this frame.
};

// The portrait of a person, as wide as the panel. It rotates by dragging, or with the arrow keys
// while it has the keyboard focus; the framing is chosen below. The old picture stays while the
// person is built again. bones: draws the skeleton over it; a click on a joint highlights it.
void DrawPortrait(editor::Workspace& workspace,
                  CastView& cast_view,
                  PictureTextures& pictures,
                  const Input& input,
                  const editor::CastDocument& member,
                  bool bones);

}  // namespace lararium::panels
