#include "player/app/quality_control.h"

#include <algorithm>
#include <span>

namespace lararium::player {
namespace {

constexpr double kPowerSeconds = 5.0;

}  // namespace

void QualityControl::Adapt(double frames_per_second) {
  const size_t levels = render::QualityLadder().size();
  controller_.emplace(show::QualityOptions::ForCamera(levels, frames_per_second), levels - 1);
  power_.emplace(kPowerSeconds);
}

const render::Quality& QualityControl::quality() const {
  const std::span<const render::Quality> ladder = render::QualityLadder();
  return ladder[std::min(level(), ladder.size() - 1)];
}

bool QualityControl::AfterFrame(double time, std::optional<double> work_ms, Log& log) {
  if (!controller_) {
    return false;
  }
  const size_t before = controller_->level();
  if (work_ms) {
    controller_->AddFrame(time, *work_ms);
  }
  if (const std::optional<show::PowerState> power = power_->Take()) {
    controller_->SetPower(time, *power);
  }
  if (controller_->level() == before) {
    return false;
  }
  log.Info("quality {} instead of {}: {}", controller_->level(), before,
           show::Name(controller_->steps().back().reason));
  return true;
}

}  // namespace lararium::player
