#pragma once

// What is to be read at the moment of a frame, over its finished picture.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/captions.h"
#include "shared/show/show.h"

namespace lararium::show {

// What captions need of a show.
struct CaptionTexts {
  std::vector<std::vector<stage::CaptionCue>> lines;  // by ShowContent::speech
  std::vector<std::string> speakers;                  // by ShowContent::cast
};
CaptionTexts TextsOf(const ShowContent& content);

// The caption so many seconds after its line began; nullptr: none then.
const stage::CaptionCue* FindCue(std::span<const stage::CaptionCue> cues, double seconds);

// Where a speaker is who cannot be seen because the camera looks elsewhere.
render::CaptionSide SideOf(const StagedFrame& staged, uint32_t cast);

// At most two captions, those that began last; the newest lowest.
void CollectCaptions(const CaptionTexts& texts,
                     const StagedFrame& staged,
                     std::vector<render::Caption>& captions);

class Evidence;

// Captions of a show that has letters for them.
class ShowCaptions {
 public:
  static Result<std::unique_ptr<ShowCaptions>> Create(const ShowContent& content);

  // evidence: whose legend is drawn too; nullptr: none.
  void Draw(const StagedFrame& staged, Evidence* evidence, const render::RenderTarget& target);

 private:
  ShowCaptions() = default;

  CaptionTexts texts_;
  std::unique_ptr<render::CaptionPainter> painter_;  // none: the show has no captions
  std::vector<render::Caption> captions_;
};

}  // namespace lararium::show
