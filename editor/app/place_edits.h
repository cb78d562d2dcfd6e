#pragma once

// Edits of a place that the window and the subcommands make alike.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "editor/app/project.h"
#include "shared/core/status.h"
#include "shared/stage/picks.h"

namespace lararium::app {

// In an image an anchor has one pick: a new one takes the place of the one before.
void SetPick(stage::Anchor& anchor, const stage::Pick& pick);

// The anchors of a place's stage: origin, forward, floor, length_from, length_to.
std::vector<std::string> AnchorNames();
// nullptr: none is called so.
stage::Anchor* FindAnchor(stage::StagePicks& picks, std::string_view name);

// Shapes and models of another place whose names are not taken here: they lie in stage metres, so
// what is built at one place is often there at the other too. Without what they were aligned by.
// How many that were.
size_t TakeOverOccluders(const PlaceDocument& from, PlaceDocument& place);

// A recording as documents name it: a folder is one of images, all else a video.
SourceDocument RecordingAt(const ProjectPaths& paths, const std::filesystem::path& file);

// Puts a place before the others: the window opens with it. Nothing where none is called so.
void PutPlaceFirst(const std::string& name, ProjectDocument& document);

// The folder of a place has another name too, before an edit that names the place anew: undo and
// redo find its files under either. Files that are there from an earlier renaming stay. Fails where
// they cannot be written, or where that folder is of another map.
Status GiveFolderOtherName(const ProjectPaths& paths,
                           const std::string& from,
                           const std::string& to);

// That edit: names a place, and all that the document names in its folder, anew. Nothing where none
// is called so.
void NamePlaceAnew(const ProjectPaths& paths,
                   const std::string& from,
                   const std::string& to,
                   ProjectDocument& document);

// Gives a place another name, and its folder too, with all that the document names in there, and
// saves the project. Whenever it is cut off, the project on the disk finds all its files: the
// folder has both names until it is saved. Fails, and nothing has changed, where files cannot be
// written.
Status RenamePlace(const ProjectPaths& paths,
                   const std::string& from,
                   const std::string& to,
                   ProjectDocument& document);

}  // namespace lararium::app
