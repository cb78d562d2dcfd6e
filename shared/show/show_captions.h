#pragma once

// Draws the texts of a frame over its finished picture: captions, the guide for a visitor whose
// tracking is lost, and the tracking state for staff.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/text/captions.h"
#include "shared/render/text/menu.h"
#include "shared/show/caption_texts.h"
#include "shared/show/show.h"

namespace lararium::show {

class Evidence;

// Tracking state for staff: "following 0.98", "lost for 3.2 s: too dark".
std::string TrackingText(const StagedFrame& staged);

// Without a caption font only the pictures of guides are drawn.
class ShowCaptions {
 public:
  static Result<std::unique_ptr<ShowCaptions>> Create(const ShowContent& content);

  // Shows the tracking state followed by this text; nullopt: neither.
  void SetStaff(std::optional<std::string> more) { staff_ = std::move(more); }

  // Style of all texts except the menu, which has its own.
  void SetStyle(const render::CaptionStyle& style) { style_ = style; }

  // Shows a menu over everything; nullopt: none.
  void SetMenu(std::optional<render::Menu> menu) { menu_ = std::move(menu); }

  // evidence: also draws its legend; nullptr: no legend.
  void Draw(const StagedFrame& staged, Evidence* evidence, const render::RenderTarget& target);

 private:
  ShowCaptions() = default;

  void DrawGuide(const StagedFrame& staged, const render::RenderTarget& target);

  CaptionTexts texts_;
  std::vector<std::string> guides_;  // Parallel to ShowContent::places.
  std::string dark_guide_;
  std::string farewell_;
  render::CaptionStyle style_;
  std::optional<std::string> staff_;
  std::optional<render::Menu> menu_;
  std::unique_ptr<render::CaptionPainter> painter_;
  std::vector<render::Caption> captions_;
};

}  // namespace lararium::show
