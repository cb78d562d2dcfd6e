#pragma once

// Sets up the stage on which a drama runs without being drawn.

#include <string>

#include "editor/document/project.h"
#include "shared/core/status.h"
#include "shared/show/show_content.h"
#include "shared/stage/stage.h"

namespace lararium::editor {

// Places the whole cast and all objects on the stage, as in a show with the given spoken language;
// "": the first language of the project. content: receives its lines.
Status FillStage(const ProjectPaths& paths,
                 const ProjectDocument& document,
                 const std::string& spoken,
                 stage::Stage& stage,
                 show::ShowContent& content);

}  // namespace lararium::editor
