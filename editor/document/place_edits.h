#pragma once

// Edits of a place, shared by the window and the subcommands.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/status.h"
#include "shared/stage/picks.h"

namespace lararium::editor {

// Replaces the anchor's pick in the same image, if there is one: an anchor has one pick per image.
void SetPick(stage::Anchor& anchor, const stage::Pick& pick);

// The names of the anchors that define a stage: origin, forward, floor, length_from, length_to.
std::vector<std::string> AnchorNames();
// Returns nullptr where there is no anchor of this name.
stage::Anchor* FindAnchor(stage::StagePicks& picks, std::string_view name);

// Copies the shapes and models of another place, except those whose names exist here. They lie in
// stage metres, so one building often serves two places. The point pairs that aligned a model are
// not copied. Returns the number of copied occluders.
size_t TakeOverOccluders(const PlaceDocument& from, PlaceDocument& place);

// The document entry for a recording: a folder is a sequence of images, everything else is a video.
SourceDocument RecordingAt(const ProjectPaths& paths, const std::filesystem::path& file);

// Moves a place to the front of the list: the window opens with it. Does nothing where there is no
// such place.
void PutPlaceFirst(const std::string& name, ProjectDocument& document);

// Makes the folder of a place available under a second name as well, before an edit that renames
// the place: undo and redo find its files under both. Keeps files that an earlier renaming left
// there. Fails where the files cannot be written, or where a folder of that name belongs to another
// map.
Status GiveFolderOtherName(const ProjectPaths& paths,
                           const std::string& from,
                           const std::string& to);

// The edit itself: renames a place and updates all paths of the document that lead into its folder.
// Does nothing where there is no such place.
void RenamePlaceInDocument(const ProjectPaths& paths,
                           const std::string& from,
                           const std::string& to,
                           ProjectDocument& document);

// Renames a place and its folder, updates all paths of the document that lead into the folder, and
// saves the project. The folder has both names until the project is saved, so a crash at any moment
// leaves a project that finds all its files. On an error nothing has changed.
Status RenamePlace(const ProjectPaths& paths,
                   const std::string& from,
                   const std::string& to,
                   ProjectDocument& document);

// The occluder for another place, which has other images.
OccluderDocument WithoutPicks(OccluderDocument occluder);

}  // namespace lararium::editor
