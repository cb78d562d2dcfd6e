#include "shared/show/show_captions.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "shared/render/text/notice.h"
#include "shared/show/evidence.h"

namespace lararium::show {
namespace {

constexpr size_t kMostAtOnce = 2;

// Colours of the staff's status dot, sRGB.
constexpr glm::vec3 kGood = {0.35f, 0.80f, 0.45f};
constexpr glm::vec3 kPoor = {0.95f, 0.75f, 0.25f};
constexpr glm::vec3 kBad = {0.92f, 0.35f, 0.30f};
constexpr double kLongLoss = 2.0;  // seconds

// Light colours that are easy to distinguish on a dark background, also for colour-blind people
// (after Okabe & Ito, Color Universal Design, 2008, lightened), in the order of the cast.
constexpr std::array<glm::vec3, 6> kColours = {{{0.98f, 0.80f, 0.36f},
                                                {0.52f, 0.80f, 0.98f},
                                                {0.60f, 0.90f, 0.68f},
                                                {0.98f, 0.70f, 0.56f},
                                                {0.90f, 0.74f, 0.94f},
                                                {0.96f, 0.94f, 0.60f}}};

// A caption without speech has no voice to follow: its last cue stays as long as the line is shown.
const stage::CaptionCue* CueOf(const CaptionTexts& texts, const StagedLine& line) {
  const std::vector<stage::CaptionCue>& cues = texts.lines[line.line];
  if (line.cast != StagedLine::kNobody || cues.empty()) {
    return FindCue(cues, line.seconds);
  }
  const auto later = std::find_if(cues.begin(), cues.end(), [&](const stage::CaptionCue& cue) {
    return cue.end > line.seconds;
  });
  return later == cues.end() ? &cues.back() : &*later;
}

}  // namespace

CaptionTexts TextsOf(const ShowContent& content) {
  CaptionTexts texts;
  for (const Speech& line : content.speech) {
    std::vector<stage::CaptionCue>& cues = texts.lines.emplace_back(line.captions);
    for (size_t i = 0; line.describes && i < cues.size(); ++i) {
      cues[i].text = "[" + cues[i].text + "]";
    }
  }
  for (const CastMember& member : content.cast) {
    texts.speakers.push_back(member.title);
  }
  return texts;
}

const stage::CaptionCue* FindCue(std::span<const stage::CaptionCue> cues, double seconds) {
  const auto found = std::find_if(cues.begin(), cues.end(), [seconds](const auto& cue) {
    return seconds >= cue.begin && seconds < cue.end;
  });
  return found == cues.end() ? nullptr : &*found;
}

render::CaptionSide SideOf(const StagedFrame& staged, uint32_t cast) {
  const auto actor = std::find_if(staged.people.actors.begin(), staged.people.actors.end(),
                                  [cast](const StagedActor& a) { return a.cast == cast; });
  if (!staged.camera.camera_from_stage || actor == staged.people.actors.end()) {
    return render::CaptionSide::kHere;
  }
  constexpr float kHead = 1.5f;  // metres
  const glm::vec4 head = actor->stage_from_actor * glm::vec4(0.0f, kHead, 0.0f, 1.0f);
  const Eigen::Vector3d in_camera =
      *staged.camera.camera_from_stage * Eigen::Vector3d(head.x, head.y, head.z);
  const geometry::CameraModel display = staged.tracked.camera.DisplayPinhole();
  const double across = display.fx * in_camera.x() + display.cx * in_camera.z();
  if (in_camera.z() <= 0.0) {
    return in_camera.x() < 0.0 ? render::CaptionSide::kLeft : render::CaptionSide::kRight;
  }
  if (across < 0.0) {
    return render::CaptionSide::kLeft;
  }
  return across > display.width * in_camera.z() ? render::CaptionSide::kRight
                                                : render::CaptionSide::kHere;
}

void CollectCaptions(const CaptionTexts& texts,
                     const StagedFrame& staged,
                     std::vector<render::Caption>& captions) {
  captions.clear();
  // Iterate by increasing age of the lines: few people speak at once.
  double after = -1.0;
  uint32_t after_cast = 0;
  while (captions.size() < kMostAtOnce) {
    const StagedLine* next = nullptr;
    for (const StagedLine& line : staged.lines) {
      const bool is_later =
          line.seconds > after || (line.seconds == after && line.cast > after_cast);
      if (is_later && CueOf(texts, line) != nullptr &&
          (next == nullptr || line.seconds < next->seconds)) {
        next = &line;
      }
    }
    if (next == nullptr) {
      return;
    }
    after = next->seconds;
    after_cast = next->cast;
    render::Caption& caption = captions.emplace_back();
    caption.text = CueOf(texts, *next)->text;
    if (next->cast != StagedLine::kNobody && next->cast != StagedLine::kDescription) {
      caption.speaker = texts.speakers[next->cast];
      caption.colour = kColours[next->cast % kColours.size()];
      caption.side = SideOf(staged, next->cast);
    }
  }
}

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
  for (const ShowPlace& place : content.places) {
    captions->guides_.push_back(place.guide);
  }
  captions->dark_guide_ = content.dark_guide;
  captions->farewell_ = content.farewell;
  LARARIUM_ASSIGN_OR_RETURN(
      captions->painter_,
      render::CaptionPainter::Create(content.caption_font.value_or(render::CaptionFont())));
  captions->captions_.reserve(kMostAtOnce);
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
