#include "shared/show/show_captions.h"

#include <cstdio>

#include "shared/render/text/notice.h"
#include "shared/show/evidence.h"

namespace lararium::show {
namespace {

// Colours of the staff's status dot, sRGB.
constexpr glm::vec3 kGood = {0.35f, 0.80f, 0.45f};
constexpr glm::vec3 kPoor = {0.95f, 0.75f, 0.25f};
constexpr glm::vec3 kBad = {0.92f, 0.35f, 0.30f};
constexpr double kLongLoss = 2.0;  // seconds

}  // namespace

std::string TrackingText(const StagedFrame& staged) {
  const vision::TrackedFrame& tracked = staged.tracked;
  char text[96];
  if (tracked.camera_from_map) {
    std::snprintf(text, sizeof(text), "%s %.2f", tracked.followed ? "following" : "found",
                  static_cast<double>(tracked.confidence));
    return text;
  }
  const char* what =
      staged.camera.state == TrackingLossFader::State::kSearching ? "searching" : "lost";
  std::snprintf(text, sizeof(text), "%s for %.1f s: %s", what, staged.camera.lost_seconds,
                std::string(vision::Name(tracked.reason)).c_str());
  return text;
}

Result<std::unique_ptr<ShowCaptions>> ShowCaptions::Create(const ShowContent& content) {
  std::unique_ptr<ShowCaptions> captions(new ShowCaptions());
  captions->texts_ = TextsOf(content);
  captions->guides_.resize(content.places.size());
  if (content.caption_font) {  // Nothing is written without letters.
    for (size_t i = 0; i < content.places.size(); ++i) {
      captions->guides_[i] = content.places[i].guide;
    }
    captions->dark_guide_ = content.dark_guide;
    captions->farewell_ = content.farewell;
  }
  LARARIUM_ASSIGN_OR_RETURN(
      captions->painter_,
      render::CaptionPainter::Create(content.caption_font.value_or(render::CaptionFont())));
  captions->captions_.reserve(kMostCaptions);
  return captions;
}

void ShowCaptions::DrawGuide(const StagedFrame& staged, const render::RenderTarget& target) {
  render::Notice notice;
  notice.opacity = staged.camera.guide.opacity;
  notice.style = style_;
  switch (staged.camera.guide.says) {
    case StagedGuide::Says::kLookThere:
      notice.text = guides_[staged.camera.place];
      notice.picture = staged.camera.guide.picture;
      notice.picture_number = staged.camera.guide.picture_number;
      break;
    case StagedGuide::Says::kDark:
      notice.text = dark_guide_;
      break;
    case StagedGuide::Says::kFarewell:
      notice.text = farewell_;
      break;
  }
  render::DrawNotice(painter_->flat(), notice, target);
}

void ShowCaptions::Draw(const StagedFrame& staged,
                        Evidence* evidence,
                        const render::RenderTarget& target) {
  const bool has_letters = !painter_->flat().font().glyphs.empty();
  if (has_letters && (!staged.lines.empty() || evidence != nullptr)) {
    CollectCaptions(texts_, staged, captions_);
    painter_->Draw(captions_, evidence != nullptr ? &evidence->LegendOf(staged) : nullptr, style_,
                   target);
  }
  if (staged.camera.guide.opacity > 0.0f) {
    DrawGuide(staged, target);
  }
  if (staff_) {
    const bool tracking = staged.tracked.camera_from_map.has_value();
    const bool gone = staged.camera.lost_seconds > kLongLoss;
    render::DrawStatus(painter_->flat(),
                       tracking ? kGood
                       : gone   ? kBad
                                : kPoor,
                       TrackingText(staged) + *staff_, target);
  }
  if (menu_) {
    render::DrawMenu(painter_->flat(), *menu_, target);
  }
}

}  // namespace lararium::show
