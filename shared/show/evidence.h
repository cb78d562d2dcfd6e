#pragma once

// The evidence view: colours every person and object by certainty, and shows a legend and the
// evidence for the person or object that the visitor looks at.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/render/render_scene.h"
#include "shared/render/text/captions.h"
#include "shared/show/show.h"
#include "shared/stage/paradata.h"

namespace lararium::show {

// The legend's word for a certainty in a language, or in English if the program does not know it.
std::string_view EvidenceWord(stage::Certainty certainty, std::string_view language);

class Evidence {
 public:
  explicit Evidence(const ShowContent& content);

  // height: of the picture, in pixels.
  render::SceneMark MarkOfActor(uint32_t cast, int height) const;
  render::SceneMark MarkOfObject(uint32_t object, int height) const;

  // The legend of a frame, with the evidence for the person or object in the middle of the view.
  // Valid until the next call.
  const render::Legend& LegendOf(const StagedFrame& staged);

 private:
  struct Known {
    stage::Certainty certainty = stage::Certainty::kUnsaid;
    std::string title;
    std::string text;
  };
  // The person or object in the middle of the view: an index into known_.
  std::optional<size_t> LookedAt(const StagedFrame& staged) const;

  size_t cast_count_ = 0;
  std::vector<Known> known_;  // The cast, followed by the objects.
  std::array<render::LegendEntry, stage::kCertaintyCount> entries_;
  std::optional<size_t> looked_at_;  // Result of the last LookedAt().
  render::Legend legend_;
};

}  // namespace lararium::show
