#include "player/kiosk/kiosk.h"

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
    log_.Warn("{}; the kiosk starts with a new state", state.message());
  }
  statistics_ = LoadVisitStatistics(folder, log);
  counter_ = VisitCounter(start.number > 0 && state_.seconds > 0.0);
  if (start.number > 0) {
    ++statistics_.Day(Today()).restarts;
  }
  writer_ = std::jthread([this, folder = std::move(folder)] { Write(folder); });
}

Kiosk::~Kiosk() {
  statistics_to_write_.Put(statistics_);
  to_write_.Close();  // the writer still writes the last state
  writer_.join();
}

// Runs on the writer's thread. Statistics are written together with the state, but less often.
void Kiosk::Write(const std::filesystem::path& folder) {
  bool told = false;
  bool statistics_told = false;
  while (const std::optional<KioskState> next = to_write_.Take({})) {
    const Status status = SaveKioskState(folder, *next);
    if (!status.ok() && !told) {
      log_.Warn("{}; after a failure the show will begin at its beginning", status.message());
    }
    if (status.ok() && told) {
      log_.Info("where the show is can be kept again");
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
      log_.Warn("{}; what is counted is not kept", status.message());
    } else if (status.ok() && told) {
      log_.Info("what is counted can be kept again");
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

void Kiosk::Welcome(double now, show::Show& show) {
  log_.Info("a visitor came: the show begins");
  visit_.Begin(now);
  new_visitor_ = true;
  show.input().RestartAt(0.0);
}

void Kiosk::BeforeFrame(show::StagedFrame& staged) const {
  if (!visit_.over()) {
    return;
  }
  staged.camera.opacity *= visit_.shown();
  staged.lines.clear();
  staged.camera.guide.opacity = visit_.farewell();
  staged.camera.guide.says = show::StagedGuide::Says::kFarewell;
}

void Kiosk::AfterFrame(double now, const show::StagedFrame& staged, show::Show& show) {
  const bool tracked = staged.tracked.camera_from_map.has_value();
  switch (watch_.Update(now, tracked ? staged.camera.camera_from_stage : std::nullopt)) {
    case VisitorWatch::Event::kCame:
      Welcome(now, show);
      break;
    case VisitorWatch::Event::kLeft:
      log_.Info("the visitor left");
      break;
    case VisitorWatch::Event::kNone:
      break;
  }
  if (visit_.Update(now, watch_.noticed())) {
    log_.Info("the visit is over");
    watch_.Leave();
  }
  Count(now, staged, show.content());
  state_.title = show.content().title;
  state_.seconds = watch_.present() ? staged.time : 0.0;
  if (now - remembered_ >= kRememberSeconds) {
    KeepStatistics(now);
    Remember(now);
  }
}

void Kiosk::Count(double now, const show::StagedFrame& staged, const show::ShowContent& content) {
  if (today_.empty()) {
    today_ = Today();
  }
  const Eigen::Vector3d at = staged.camera.camera_from_stage
                                 ? staged.camera.camera_from_stage->Center()
                                 : Eigen::Vector3d::Zero();
  // A choice that was not made is the first language.
  const auto chosen = [](const std::string& choice, const std::vector<std::string>& offered) {
    return std::string_view(!choice.empty() || offered.empty() ? choice : offered.front());
  };
  counter_.Count({.now = now,
                  .noticed = watch_.noticed(),
                  .last_sign = watch_.last_sign(),
                  .tracked = staged.tracked.camera_from_map.has_value() &&
                             staged.camera.camera_from_stage.has_value(),
                  .people_went = staged.camera.state == show::TrackingLossFader::State::kGone,
                  .drama_time = staged.time,
                  .story_length = story_length_,
                  .place = content.places[staged.camera.place].stage.name,
                  .at = {at.x(), at.z()},
                  .language = chosen(state_.choices.language, content.spoken_languages),
                  .captions = chosen(state_.choices.captions, content.caption_languages)},
                 statistics_.Day(today_));
}

// Hands the statistics to the writer every minute, and when a visitor came or left.
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
    Welcome(now, show);
  }
}

void Kiosk::BeginAgain(double now, show::Show& show) {
  if (visit_.over()) {
    watch_.Leave();
    Touch(now, show);
  } else {
    show.input().RestartAt(0.0);
  }
}

void Kiosk::Keep(const Choices& choices, const Choices& house, double now) {
  state_.choices = choices;
  state_.house = house;
  Remember(now);
}

}  // namespace lararium::player
