#pragma once

// Who made what a show consists of, and on which evidence: the project's own words, the
// authors and licences of people and objects as they were built, the claims of
// paradata.json, letters and voices.

#include <string>

#include "editor/app/project.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::app {

struct Credits {
  std::string text;  // for people, lines
  Json json;         // docs/file-formats.md
};

// Fails where somebody or something was not baked: what it is made of is not known before.
Result<Credits> MakeCredits(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::app
