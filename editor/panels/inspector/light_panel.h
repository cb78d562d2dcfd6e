#pragma once

// The inspector of a light probe: its picture with the sun, and its rotation and brightness, set by
// hand or matched to the place.

#include <span>

#include "editor/panels/widgets/editor_state.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

void DrawLightPanel(editor::Workspace& workspace,
                    EditorState& state,
                    const editor::ProbeDocument& probe);

// Handles keys of KeyScope::kLight. Returns true where the key is one of them and a probe is
// selected.
bool HandleLightKey(editor::Workspace& workspace, EditorState& state, const KeyPress& press);

// The selected probe; nullptr where none is selected.
const editor::ProbeDocument* SelectedProbe(const editor::Workspace& workspace,
                                           const EditorState& state);

// Edits the selected probe, as one command with a name.
void TurnProbe(editor::Workspace& workspace,
               const editor::ProbeDocument& probe,
               const glm::quat& stage_from_probe,
               const Sentence& name,
               const char* gesture);
// Complete a pick on the stage that the panel has started. The direction is from the probe.
void AddGreyPatch(editor::Workspace& workspace,
                  EditorState& state,
                  const editor::ProbeDocument& probe,
                  const bake::GreyPatch& patch);
void AddDirection(editor::Workspace& workspace,
                  EditorState& state,
                  const editor::ProbeDocument& probe,
                  const glm::vec3& in_stage);

// How the balls and the panorama show a probe: with its brightness, and with the camera's gain
// where there is a picture.
editor::ProbeLook LookAtProbe(const editor::Workspace& workspace,
                              const editor::ProbeDocument& probe);

}  // namespace lararium::panels
