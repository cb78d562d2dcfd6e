#pragma once

// The inspector of a light probe: its picture with the sun, and its rotation and brightness, set by
// hand or matched to the place.

#include <span>

#include "editor/bake/probe_match.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/keys.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// The state of the light panel.
struct LightView {
  enum class Picking { kNothing, kGrey, kOnProbe, kOnStage };
  Picking picking = Picking::kNothing;
  bool level = true;       // Drags rotate about the vertical only.
  bool balls = true;       // Shows a mirror ball and a grey ball at the probe.
  bool histogram = false;  // Compares the camera's image with people.
  float albedo = 0.18f;    // Albedo of picked grey surfaces.
  std::string probe;       // The probe that the picks below belong to.
  std::vector<bake::GreyPatch> patches;
  std::optional<bake::ScaleMatch> scale_match;
  std::vector<bake::DirectionPair> pairs;
  std::optional<glm::vec3> in_probe;  // The first half of the next pair.
  std::optional<bake::DirectionMatch> direction_match;
  std::string problem;  // Why the last pick failed; empty: it did not.
  // The direction that a drag keeps under the pointer.
  std::optional<glm::vec3> dragged_in_probe;
};

void DrawLightPanel(editor::Workspace& workspace,
                    ViewOptions& options,
                    LightView& light,
                    PictureTextures& pictures,
                    const editor::ProbeDocument& probe);

// Handles keys of KeyScope::kLight. Returns true where the key is one of them and a probe is
// selected.
bool HandleLightKey(editor::Workspace& workspace,
                    const Selection& selection,
                    ViewOptions& options,
                    LightView& light,
                    const KeyPress& press);

// The selected probe; nullptr where none is selected.
const editor::ProbeDocument* SelectedProbe(const editor::Workspace& workspace,
                                           const Selection& selection);

// Edits the selected probe, as one command with a name.
void TurnProbe(editor::Workspace& workspace,
               const editor::ProbeDocument& probe,
               const glm::quat& stage_from_probe,
               const Sentence& name,
               const char* gesture);
// Complete a pick on the stage that the panel has started. The direction is from the probe.
void AddGreyPatch(editor::Workspace& workspace,
                  LightView& light,
                  const editor::ProbeDocument& probe,
                  const bake::GreyPatch& patch);
void AddDirection(editor::Workspace& workspace,
                  LightView& light,
                  const editor::ProbeDocument& probe,
                  const glm::vec3& in_stage);

// How the balls and the panorama show a probe: with its brightness, and with the camera's gain
// where there is a picture.
editor::ProbeLook LookAtProbe(const editor::Workspace& workspace,
                              const editor::ProbeDocument& probe);

}  // namespace lararium::panels
