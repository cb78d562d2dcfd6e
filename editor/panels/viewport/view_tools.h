#pragma once

// The tools of the views. A tool works in several views, and the inspector or the toolbar shows its
// settings.

#include "editor/panels/inspector/light_panel.h"
#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/viewport/walk_view.h"

namespace lararium::panels {

struct ViewTools {
  GizmoTool gizmo;
  PickTarget picks;
  PlaceView place;
  WalkHandles walks;
  CheckView check;
  AlignView align;
  LightView light;
};

}  // namespace lararium::panels
