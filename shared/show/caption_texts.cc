#include "shared/show/caption_texts.h"

#include <algorithm>
#include <array>

namespace lararium::show {
namespace {

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
  while (captions.size() < kMostCaptions) {
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

}  // namespace lararium::show
