#pragma once

// What the timeline's items and blocks are called on the screen.

#include <string>

#include "shared/core/json.h"
#include "shared/drama/drama.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

// What an item says in a few words.
std::string LabelOf(drama::LaneKind kind, const Json& fields);

// What was done without the timeline. of_object: on the row of a thing, which says by whom.
std::string BlockLabel(const drama::TaskRecord& task, bool of_object);

}  // namespace lararium::panels
