#pragma once

// The evidence view: every person and thing in the colour of how certain it is, a legend,
// and what is known of whatever the visitor looks at.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/render/captions.h"
#include "shared/render/render_scene.h"
#include "shared/show/show.h"
#include "shared/stage/paradata.h"

namespace lararium::show {

// What the legend calls it, in the language or else in English.
std::string_view EvidenceWord(stage::Certainty certainty, std::string_view language);

class Evidence {
 public:
  explicit Evidence(const ShowContent& content);

  // Of a picture so many pixels high.
  render::SceneMark MarkOfActor(uint32_t cast, int height) const;
  render::SceneMark MarkOfObject(uint32_t object, int height) const;

  // For a frame, with what it says of the person or thing in the middle of the view. Borrowed
  // until the next call.
  const render::Legend& LegendOf(const StagedFrame& staged);

 private:
  struct Known {
    stage::Certainty certainty = stage::Certainty::kUnsaid;
    std::string title;
    std::string text;
  };
  // Of actors, and of objects behind them, by index into known_.
  std::optional<size_t> LookedAt(const StagedFrame& staged) const;

  size_t cast_count_ = 0;
  std::vector<Known> known_;  // of the cast, then of the objects
  std::array<render::LegendEntry, stage::kCertaintyCount> entries_;
  std::optional<size_t> looked_at_;  // last
  render::Legend legend_;
};

}  // namespace lararium::show
