#pragma once

// Edits of somebody's recorded motions, as the window and the subcommand make them.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "editor/app/cast_document.h"
#include "shared/core/status.h"

namespace lararium::app {

// Whether one of somebody's motions can be called so from now on: a name of the drama, and none
// that another of them has.
Status CheckClipName(const CastDocument& member, const std::string& name);

// Adds a motion, in place of one of that name. Fails where it cannot be called so.
Status AddClip(ClipDocument clip, CastDocument& member);
// These fail where there is no such motion, and do nothing then.
Status RenameClip(const std::string& name, const std::string& to, CastDocument& member);
Status RemoveClip(const std::string& name, CastDocument& member);

// The lines of a script, from 1, that say a word as a text: "wave", 'wave'. Comments say nothing,
// and what a script puts together out of pieces is not found.
std::vector<size_t> LinesThatSay(std::string_view script, std::string_view word);

}  // namespace lararium::app
