#pragma once

// A light probe in the inspector: its picture with the sun, how it lies and how bright it is,
// by hand and matched to the place.

#include <span>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"

namespace lararium::panels {

void ShowLightPanel(app::Workspace& workspace, EditorState& state, const app::ProbeDocument& probe);

// Of KeyScope::kLight. True where the key was one of them and a probe is selected.
bool HandleLightKey(app::Workspace& workspace, EditorState& state, const KeyPress& press);

// The probe that is selected; nullptr where none is.
const app::ProbeDocument* SelectedProbe(const app::Workspace& workspace, const EditorState& state);

// Edits of the selected probe, each a command with a name.
void TurnProbe(app::Workspace& workspace,
               const app::ProbeDocument& probe,
               const glm::quat& stage_from_probe,
               const char* name,
               const char* gesture);
// Picks on the stage, which complete what the panel began. Direction: from the probe.
void AddGreyPatch(app::Workspace& workspace,
                  EditorState& state,
                  const app::ProbeDocument& probe,
                  const bake::GreyPatch& patch);
void AddDirection(app::Workspace& workspace,
                  EditorState& state,
                  const app::ProbeDocument& probe,
                  const glm::vec3& in_stage);

// How balls and the panorama show a probe: its own brightness, and the camera's gain where a
// picture is at hand.
app::ProbeLook LookAtProbe(const app::Workspace& workspace, const app::ProbeDocument& probe);

}  // namespace lararium::panels
