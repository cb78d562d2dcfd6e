#pragma once

// Picking of the stage's points: each in two or more training images.

#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/corner_view.h"
#include "editor/session/workspace.h"
#include "shared/render/gl/texture.h"

namespace lararium::panels {

struct PanelContext;

// The anchors, indexed by PickTarget::anchor.
struct AnchorEntry {
  const char* label;
  const char* hint;
  stage::Anchor stage::StagePicks::*anchor;
};
std::span<const AnchorEntry> AnchorEntries();

// The occluder that is drawn in this view: the selected one, if it is not a model. nullptr: the
// stage's points are picked.
const editor::OccluderDocument* OccluderInWork(const editor::Workspace& workspace,
                                               const Selection& selection);

// Adds an occluder without corners and opens this view.
void DrawNewOccluder(editor::Workspace& workspace, Selection& selection, ViewOptions& options);

class PickView {
 public:
  // Fills the current window.
  void Show(const PanelContext& context);

 private:
  void DrawImage(editor::Workspace& workspace,
                 const Selection& selection,
                 PickTarget& picks,
                 const AlignView& align,
                 const vision::Keyframe& keyframe);

  render::Texture texture_;
  CornerDrag corners_;
  const vision::Keyframe* uploaded_ = nullptr;
};

}  // namespace lararium::panels
