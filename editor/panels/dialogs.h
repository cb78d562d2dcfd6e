#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "editor/app/missing_files.h"
#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/text.h"

namespace lararium::panels {

// The dialog that is open, if one is. What is wrong with what was typed is said
// in the dialog; Cancel always leads out. True: somebody wants to calibrate the camera of its
// recording (CalibrationDialog), and then come back.
bool ShowDialogs(app::Workspace& workspace, EditorState& state);

// Of files of a kind: with dots, lower case; none for folders.
std::span<const char* const> ExtensionsOf(app::FileKind kind);

// What went wrong, wrapped; nothing where the text is empty.
void WarningText(const std::string& text);

// What is wrong with the name of a project, place, person or thing; empty when nothing is.
std::string NameProblem(const std::string& name);

// What dialogs about recordings share: rows for what kind, which file and its intrinsics,
// within BeginProperties(); what is wrong with what was typed, empty when nothing is; and
// setting up the place that was typed and training it. folder: what relative paths start
// from. no_intrinsics: what an empty field stands for, and in a sentence. True: somebody wants
// to calibrate the camera (CalibrationDialog).
bool RecordingFields(const std::filesystem::path& folder,
                     DialogFields& fields,
                     const char* no_intrinsics,
                     const char* no_intrinsics_hint);
// Of recordings that are trained alone.
inline constexpr const char* kFromVideo = TrLater("from the video itself");
inline constexpr const char* kFromVideoHint = TrLater(
    "Empty: training estimates them from the video itself, and the inspector then shows the focal "
    "length with its \xc2\xb1.");
std::string RecordingProblem(const app::ProjectPaths& paths, const DialogFields& fields);
void TrainRecording(app::Workspace& workspace, const DialogFields& fields);

}  // namespace lararium::panels
