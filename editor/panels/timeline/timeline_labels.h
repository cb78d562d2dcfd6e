#pragma once

// Labels of the timeline's items and blocks.

#include <string>

#include "shared/core/json.h"
#include "shared/drama/drama.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

// The label of an item, in a few words.
std::string LabelOf(drama::LaneKind kind, const Json& fields);

// The label of a task of the script. of_object: on the row of an object, where the label names the
// person.
std::string BlockLabel(const drama::TaskRecord& task, bool of_object);

}  // namespace lararium::panels
