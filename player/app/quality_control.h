#pragma once

// The quality level at which pictures are drawn: fixed, or adapted to the speed and the power of
// the machine.

#include <cstddef>
#include <optional>

#include "player/kiosk/power_sensors.h"
#include "shared/core/json.h"
#include "shared/core/log.h"
#include "shared/render/quality.h"
#include "shared/show/quality_controller.h"

namespace lararium::player {

class QualityControl {
 public:
  // A fixed level of render::QualityLadder().
  explicit QualityControl(size_t level) : fixed_(level) {}

  // Adapts the level from now on. It starts at the coarsest, so that visitors never wait for
  // pictures that are too slow.
  void Adapt(double frames_per_second);

  size_t level() const { return controller_ ? controller_->level() : fixed_; }
  const render::Quality& quality() const;

  // Call this after each frame. time: seconds. work_ms: time that the slowest stage of the frame
  // took; nullopt: the frame shows no people. Returns whether the level changed, which is logged.
  bool AfterFrame(double time, std::optional<double> work_ms, Log& log);

  // See show::ShowStatistics::quality.
  Json ToJson() const { return controller_ ? controller_->ToJson() : Json(Json::object()); }

 private:
  size_t fixed_;
  std::optional<show::QualityController> controller_;
  std::optional<PowerWatch> power_;  // Set if the level is adapted.
};

}  // namespace lararium::player
