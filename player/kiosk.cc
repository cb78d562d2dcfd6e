#include "player/kiosk.h"

#include <cstdlib>
#include <utility>

namespace lararium::player {
namespace {

constexpr double kRememberSeconds = 1.0;
constexpr int kMostFailedStarts = 2;

}  // namespace

std::filesystem::path DefaultStateFolder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && state[0] == '/') {
    return std::filesystem::path(state) / "lararium";
  }
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : "/var/tmp") / ".local/state/lararium";
}

Kiosk::Kiosk(std::filesystem::path folder, const ChildStart& start, Log& log)
    : log_(log), fresh_(start.failed_starts > kMostFailedStarts) {
  Result<KioskState> state = LoadKioskState(folder);
  if (state.ok()) {
    state_ = *state;
  } else {
    log_.warn("{}; the kiosk begins anew", state.message());
  }
  writer_ = std::jthread([this, folder = std::move(folder)](const std::stop_token& stop) {
    bool told = false;
    while (const std::optional<KioskState> next = to_write_.Take(stop)) {
      const Status status = SaveKioskState(folder, *next);
      if (!status.ok() && !told) {
        log_.warn("{}; after a failure the show will begin at its beginning", status.message());
      }
      told = !status.ok();
    }
  });
}

double Kiosk::ResumeAt(const std::string& title) const {
  return !fresh_ && state_.title == title ? state_.seconds : 0.0;
}

void Kiosk::Remember(double now) {
  remembered_ = now;
  to_write_.Put(state_);
}

void Kiosk::AfterFrame(double now, const show::StagedFrame& staged, show::Show& show) {
  const bool tracked = staged.tracked.camera_from_map.has_value();
  switch (watch_.Update(now, tracked ? staged.camera_from_stage : std::nullopt)) {
    case VisitorWatch::Event::kCame:
      log_.info("a visitor came: the show begins");
      show.RestartAt(0.0);
      break;
    case VisitorWatch::Event::kLeft:
      log_.info("the visitor left");
      break;
    case VisitorWatch::Event::kNone:
      break;
  }
  state_.title = show.content().title;
  state_.seconds = watch_.present() ? staged.time : 0.0;
  if (now - remembered_ >= kRememberSeconds) {
    Remember(now);
  }
}

void Kiosk::Touch(double now, show::Show& show) {
  if (watch_.Touch(now) == VisitorWatch::Event::kCame) {
    show.RestartAt(0.0);
  }
}

void Kiosk::Keep(const Choices& choices, double now) {
  state_.choices = choices;
  Remember(now);
}

}  // namespace lararium::player
