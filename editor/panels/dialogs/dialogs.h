#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "editor/document/missing_files.h"
#include "editor/panels/dialogs/dialog_state.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/widgets/editor_actions.h"
#include "editor/panels/widgets/input.h"
#include "editor/panels/widgets/selection.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/view_options.h"
#include "editor/session/workspace.h"

namespace lararium::panels {

// Shows the open dialog, if there is one. The dialog reports invalid input; Cancel always closes
// it. Returns true when the user wants to calibrate the camera of its recording (CalibrationDialog)
// and then return.
bool DrawDialogs(editor::Workspace& workspace,
                 Selection& selection,
                 ViewOptions& options,
                 PictureTextures& pictures,
                 Input& input,
                 Dialogs& dialogs,
                 EditorActions& actions);

// The extensions of a kind of file, with the dot, lower case; empty for folders.
std::span<const char* const> ExtensionsOf(editor::FileKind kind);

// Shows a warning with line breaks; does nothing for an empty text.
void WarningText(const std::string& text);

// Why the name of a project, place, person or object is not valid; empty when it is.
std::string NameProblem(const std::string& name);

// Shared by dialogs about recordings. RecordingFields() shows rows for the kind, the file and the
// intrinsics, within BeginProperties(), and returns true when the user wants to calibrate the
// camera (CalibrationDialog). folder: the base of relative paths. no_intrinsics and
// no_intrinsics_hint: what an empty field means, in short and as a sentence. RecordingProblem()
// returns why the input is not valid; empty when it is. TrainRecording() adds the place and trains
// it.
bool RecordingFields(const std::filesystem::path& folder,
                     DialogFields& fields,
                     const char* no_intrinsics,
                     const char* no_intrinsics_hint);
// For recordings that are trained alone.
inline constexpr const char* kFromVideo = TrLater("from the video itself");
inline constexpr const char* kFromVideoHint = TrLater(
    "Empty: training estimates them from the video itself, and the inspector then shows the focal "
    "length with its \xc2\xb1.");
std::string RecordingProblem(const editor::ProjectPaths& paths, const DialogFields& fields);
void TrainRecording(editor::Workspace& workspace, const DialogFields& fields);

}  // namespace lararium::panels
