#pragma once

// What is to be read at the moment of a frame, over its finished picture: captions, what tells a
// visitor who has lost the place where to look, and, for staff alone, how tracking is.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/captions.h"
#include "shared/render/menu.h"
#include "shared/show/show.h"

namespace lararium::show {

// What captions need of a show.
struct CaptionTexts {
  // By ShowContent::speech; descriptions in brackets.
  std::vector<std::vector<stage::CaptionCue>> lines;
  std::vector<std::string> speakers;  // by ShowContent::cast
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

// How tracking is, for staff: "following 0.98", "lost for 3.2 s: too dark".
std::string TrackingText(const StagedFrame& staged);

// A show that has no letters has pictures only.
class ShowCaptions {
 public:
  static Result<std::unique_ptr<ShowCaptions>> Create(const ShowContent& content);

  // From now on the tracking's state is shown, with this behind it; nullopt: not.
  void SetStaff(std::optional<std::string> more) { staff_ = std::move(more); }

  // From now on; the menu has its own.
  void SetStyle(const render::CaptionStyle& style) { style_ = style; }

  // From now on over all of it; nullopt: there is none.
  void SetMenu(std::optional<render::Menu> menu) { menu_ = std::move(menu); }

  // evidence: whose legend is drawn too; nullptr: none.
  void Draw(const StagedFrame& staged, Evidence* evidence, const render::RenderTarget& target);

 private:
  ShowCaptions() = default;

  void DrawGuide(const StagedFrame& staged, const render::RenderTarget& target);

  CaptionTexts texts_;
  std::vector<std::string> guides_;  // of each place
  std::string dark_guide_;
  std::string farewell_;
  render::CaptionStyle style_;
  std::optional<std::string> staff_;
  std::optional<render::Menu> menu_;
  std::unique_ptr<render::CaptionPainter> painter_;
  std::vector<render::Caption> captions_;
};

}  // namespace lararium::show
