#pragma once

// The captions of a frame.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shared/render/text/captions.h"
#include "shared/show/show_content.h"
#include "shared/show/staged_frame.h"

namespace lararium::show {

// The texts of a show that captions use.
struct CaptionTexts {
  // Parallel to ShowContent::speech. Audio descriptions are in brackets.
  std::vector<std::vector<stage::CaptionCue>> lines;
  std::vector<std::string> speakers;  // Parallel to ShowContent::cast.
};
CaptionTexts TextsOf(const ShowContent& content);

// Returns the caption at a time after its line began, or nullptr if there is none.
const stage::CaptionCue* FindCue(std::span<const stage::CaptionCue> cues, double seconds);

// Side of the picture on which a speaker outside the view is.
render::CaptionSide SideOf(const StagedFrame& staged, uint32_t cast);

// Number of captions that are shown at once.
inline constexpr size_t kMostCaptions = 2;

// Collects the captions that began last, newest first.
void CollectCaptions(const CaptionTexts& texts,
                     const StagedFrame& staged,
                     std::vector<render::Caption>& captions);

}  // namespace lararium::show
