#pragma once

// The credits of a show: the project's own text, authors and licences of people and objects as they
// were built, the claims of paradata.json, fonts and voices.

#include <string>

#include "editor/document/project.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct Credits {
  std::string text;  // Lines of text for people to read.
  Json json;         // See docs/file-formats.md.
};

// Fails where a person or an object was not baked: its parts are not known before.
Result<Credits> MakeCredits(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::editor
