#pragma once

// The tools of the views. A tool works in several views, and the inspector or the toolbar shows its
// settings.

#include "editor/panels/inspector/light_panel.h"
#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/viewport/walk_view.h"

namespace lararium::panels {

struct CastView;
struct Dialogs;

struct ViewTools {
  GizmoTool gizmo;
  PickTarget picks;
  PlaceView place;
  WalkHandles walks;
  CheckView check;
  AlignView align;
  LightView light;
};

// The values that panels share in a frame. Functions take their parts by structured binding.
struct PanelContext {
  editor::Workspace& workspace;
  Selection& selection;
  ViewOptions& options;
  ViewTools& tools;
  CastView& cast;
  PictureTextures& pictures;
  Input& input;
  Dialogs& dialogs;
  EditorActions& actions;
};

}  // namespace lararium::panels
