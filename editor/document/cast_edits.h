#pragma once

// Edits of a cast member's recorded motions, shared by the window and the subcommands.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "editor/document/cast_document.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Checks that the name can be given to a motion of the member: it must be valid in the drama, and
// no other motion of the member may have it.
Status CheckClipName(const CastDocument& member, const std::string& name);

// Adds a motion, or replaces the one with the same name. Fails where the name is not valid.
Status AddClip(ClipDocument clip, CastDocument& member);
// Both fail and change nothing where the member has no such motion.
Status RenameClip(const std::string& name, const std::string& to, CastDocument& member);
Status RemoveClip(const std::string& name, CastDocument& member);

// The lines of a script, from 1, that contain the word as a string literal: "wave" or 'wave'.
// Comments are ignored. A string that the script concatenates is not found.
std::vector<size_t> LinesThatSay(std::string_view script, std::string_view word);

}  // namespace lararium::editor
