#include "player/kiosk.h"

#include <cstdlib>
#include <utility>

namespace lararium::player {
namespace {

constexpr double kRememberSeconds = 1.0;
constexpr double kStatisticsSeconds = 60.0;
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
  statistics_ = LoadVisitStatistics(folder, log);
  counter_ = VisitCounter(start.number > 0 && state_.seconds > 0.0);
  if (start.number > 0) {
    ++statistics_.Day(Today()).restarts;
  }
  writer_ = std::jthread(
      [this, folder = std::move(folder)](const std::stop_token& stop) { Write(folder, stop); });
}

Kiosk::~Kiosk() {
  statistics_to_write_.Put(statistics_);
  writer_.request_stop();
  writer_.join();
}

// On the writer's thread. Statistics come less often than the state, and go with it.
void Kiosk::Write(const std::filesystem::path& folder, const std::stop_token& stop) {
  bool told = false;
  bool statistics_told = false;
  while (const std::optional<KioskState> next = to_write_.Take(stop)) {
    const Status status = SaveKioskState(folder, *next);
    if (!status.ok() && !told) {
      log_.warn("{}; after a failure the show will begin at its beginning", status.message());
    }
    if (status.ok() && told) {
      log_.info("where the show is can be kept again");
    }
    told = !status.ok();
    SaveStatistics(folder, statistics_told);
  }
  SaveStatistics(folder, statistics_told);
}

void Kiosk::SaveStatistics(const std::filesystem::path& folder, bool& told) {
  if (const std::optional<VisitStatistics> statistics = statistics_to_write_.TryTake()) {
    const Status status = SaveVisitStatistics(folder, *statistics);
    if (!status.ok() && !told) {
      log_.warn("{}; what is counted is not kept", status.message());
    } else if (status.ok() && told) {
      log_.info("what is counted can be kept again");
    }
    told = !status.ok();
  }
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
  Count(now, staged);
  state_.title = show.content().title;
  state_.seconds = watch_.present() ? staged.time : 0.0;
  if (now - remembered_ >= kRememberSeconds) {
    KeepStatistics(now);
    Remember(now);
  }
}

void Kiosk::Count(double now, const show::StagedFrame& staged) {
  if (today_.empty()) {
    today_ = Today();
  }
  counter_.Count({.now = now,
                  .noticed = watch_.noticed(),
                  .last_sign = watch_.last_sign(),
                  .tracked = staged.tracked.camera_from_map.has_value(),
                  .people_went = staged.rung == show::LostLadder::Rung::kGone,
                  .drama_time = staged.time,
                  .story_length = story_length_},
                 statistics_.Day(today_));
}

// Every minute, and when somebody came or left.
void Kiosk::KeepStatistics(double now) {
  today_ = Today();
  const bool changed = std::exchange(was_noticed_, watch_.noticed()) != watch_.noticed();
  if (changed || now - kept_statistics_ >= kStatisticsSeconds) {
    kept_statistics_ = now;
    ++statistics_version_;
    statistics_to_write_.Put(statistics_);
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
