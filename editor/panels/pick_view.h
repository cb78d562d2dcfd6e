#pragma once

// Picking the stage: points of the place are clicked in training images, each in
// two or more of them.

#include "editor/app/workspace.h"
#include "editor/panels/corner_view.h"
#include "editor/panels/editor_state.h"
#include "shared/render/texture.h"

namespace lararium::panels {

// The anchors in their order in EditorState::anchor.
struct AnchorEntry {
  const char* label;
  const char* hint;
  stage::Anchor stage::StagePicks::*anchor;
};
std::span<const AnchorEntry> AnchorEntries();

// The occluder that is drawn in this view: the selected one, where it is no model. nullptr: the
// stage's points are picked.
const app::OccluderDocument* OccluderInWork(const app::Workspace& workspace,
                                            const EditorState& state);

// Adds an occluder without corners and shows the view to draw it in.
void DrawNewOccluder(app::Workspace& workspace, EditorState& state);

class PickView {
 public:
  // Fills the current window.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  void ShowImage(app::Workspace& workspace, EditorState& state, const vision::Keyframe& keyframe);

  render::Texture texture_;
  CornerDrag corners_;
  const vision::Keyframe* uploaded_ = nullptr;
};

}  // namespace lararium::panels
