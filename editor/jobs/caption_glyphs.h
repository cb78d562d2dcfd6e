#pragma once

// The letters that captions are drawn with.

#include <span>
#include <vector>

#include "editor/jobs/lines.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/render/text/caption_font.h"
#include "shared/stage/paradata.h"

namespace lararium::editor {

// The glyphs of all captions and names, those of caption files beside recordings too. Adds a
// warning for characters that the font lacks. paradata: its texts, which the evidence view shows,
// are included.
Result<render::CaptionFont> MakeCaptionFont(const ProjectLines& lines,
                                            std::span<const SpokenLine> spoken,
                                            const stage::Paradata& paradata,
                                            std::vector<Sentence>& warnings);

}  // namespace lararium::editor
