#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/editor_actions.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

struct PanelContext;

// Shows the open dialog, if there is one. The dialog reports invalid input; Cancel always closes
// it. Returns true when the user wants to calibrate the camera of its recording (CalibrationDialog)
// and then return.
bool DrawDialogs(const PanelContext& context);

// What to say of a dropped file that has no use.
std::string UselessDropText(const std::string& name);

// Shows a warning with line breaks; does nothing for an empty text.
void WarningText(const std::string& text);

// Why the name of an object, a probe or another file is not valid.
DialogProblem NameProblem(const std::string& name);

// The title of a project, a place or a person, and the plain name of its folder or in scripts.
struct TitledName {
  std::string title;
  std::string name;
};
// Two rows within BeginProperties(): the title, and its name, which follows from the title unless
// another one is typed. otherwise: the name where nothing of the title can be in a name. taken: as
// for editor::FreeNameOf().
TitledName TitleRows(const char* title_label,
                     const char* name_label,
                     const char* otherwise,
                     const std::function<bool(const std::string&)>& taken,
                     std::string& title,
                     std::string& name);
DialogProblem TitleProblem(const TitledName& titled,
                           const std::function<bool(const std::string&)>& taken);

// The place that a dialog trains: one of the project, by its title or name, or a new one. The rows
// stand within BeginProperties().
struct ChosenPlace : TitledName {
  bool known = false;
};
ChosenPlace PlaceRows(const editor::ProjectDocument& document, DialogFields& fields);
DialogProblem PlaceProblem(const editor::ProjectDocument& document, const ChosenPlace& place);

// Shared by dialogs about recordings. RecordingFields() shows rows for the kind, the file and the
// intrinsics, within BeginProperties(), and returns true when the user wants to calibrate the
// camera (CalibrationDialog). folder: the base of relative paths. no_intrinsics and
// no_intrinsics_hint: what an empty field means, in short and as a sentence. RecordingProblem()
// returns why the input is not valid. TrainRecording() adds the place and trains it.
bool RecordingFields(const std::filesystem::path& folder,
                     DialogFields& fields,
                     const char* no_intrinsics,
                     const char* no_intrinsics_hint);
// For recordings that are trained alone.
inline constexpr const char* kFromVideo = TrLater("from the video itself");
inline constexpr const char* kFromVideoHint = TrLater(
    "Empty: training estimates them from the video itself, and the inspector then shows the focal "
    "length with its \xc2\xb1.");
DialogProblem RecordingProblem(const editor::ProjectPaths& paths, const DialogFields& fields);
void TrainRecording(editor::Workspace& workspace,
                    const TitledName& place,
                    const DialogFields& fields);

}  // namespace lararium::panels
