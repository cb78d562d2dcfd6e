#include "player/app/show_session.h"

#include <algorithm>
#include <csignal>
#include <ctime>
#include <optional>
#include <utility>

#include "player/app/heap.h"
#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::player {
namespace {

// The drawing thread checks for input at least this often.
constexpr std::chrono::milliseconds kInputInterval(10);
// Without new pictures the session still counts as alive for kLongestSilence, because the camera
// may be slow. If tracking or staging one image takes longer than kLongestWork, a thread hangs.
constexpr std::chrono::seconds kLongestSilence(8);
constexpr double kLongestWork = 0.2;  // seconds
// If pictures take longer than this, the machine is so slow or busy that a long picture does not
// mean that a thread hangs.
constexpr double kSlowPicture = 250.0;  // milliseconds
// After this number of frames, all shaders of a show have been compiled.
constexpr int64_t kFirstFrames = 90;

volatile std::sig_atomic_t g_end_requested = 0;

// The hour of the day in local time.
float HourNow() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  return static_cast<float>(local.tm_hour) + static_cast<float>(local.tm_min) / 60.0f +
         static_cast<float>(local.tm_sec) / 3600.0f;
}

}  // namespace

void RequestEnd() { g_end_requested = 1; }

const render::Quality& QualityOf(size_t level) {
  const std::span<const render::Quality> fader = render::QualityLadder();
  return fader[std::min(level, fader.size() - 1)];
}

ShowSession::ShowSession(const PlayOptions& options,
                         SteadyClock::time_point started,
                         Log& log,
                         const ChildStart& start,
                         Heartbeat heartbeat,
                         int staff_link)
    : options_(options),
      started_(started),
      log_(log),
      faults_(log),
      heartbeat_(heartbeat),
      restarts_(start.number),
      maker_(options, log) {
  // Created first, because it collects all warnings of the log.
  if (staff_link >= 0) {
    staff_.emplace(staff_link, log);
  }
  if (options.kiosk) {
    kiosk_.emplace(options.state.empty() ? DefaultStateFolder() : options.state, start, log);
    kiosk_->SetVisit({.longest = 60.0 * options.visit_minutes});
    choices_ = kiosk_->state().choices;
    house_ = kiosk_->state().house;
  }
  ApplyOptions(house_);
  ApplyOptions(choices_);
}

bool ShowSession::KeepGoing(double longest_work) {
  const bool enough = options_.frames > 0 && drawn_frames_ >= options_.frames;
  const bool keep_going = g_end_requested == 0 && !enough && screen_->KeepGoing();
  PressKeys();
  ObeyStaff();
  if (drawn_frames_ > 0 && SteadyClock::now() - last_shown_ < kLongestSilence &&
      longest_work < kLongestWork) {
    heartbeat_.Beat();
  }
  if (options_.pace == Pace::kRealtime) {
    show_->input().SetHour(HourNow());
  }
  return keep_going;
}

size_t ShowSession::level() const {
  return quality_ ? quality_->level() : static_cast<size_t>(options_.quality.value_or(0));
}

void ShowSession::SetLevel(size_t level) {
  heartbeat_.BeatBeforeLongWork();  // drivers may have to compile shaders
  const render::Quality& quality = QualityOf(level);
  renderer_->SetQuality(quality);
  show_->detail().SetQuality(quality);
}

void ShowSession::ChooseQuality(SteadyClock::time_point now,
                                const show::StagedFrame& staged,
                                double work_ms) {
  if (!quality_) {
    return;
  }
  const double time = Seconds(now);
  const size_t before = quality_->level();
  if (staged.camera.camera_from_stage) {
    quality_->AddFrame(time, work_ms);
  }
  if (const std::optional<show::PowerState> power = power_->Take()) {
    quality_->SetPower(time, *power);
  }
  if (quality_->level() != before) {
    const show::QualityStep& step = quality_->steps().back();
    log_.info("quality {} instead of {}: {}", quality_->level(), before, show::Name(step.reason));
    SetLevel(quality_->level());
  }
}

void ShowSession::AddTimes(const show::StagedFrame& staged, SteadyClock::time_point drawn) {
  const SteadyClock::time_point now = SteadyClock::now();
  const auto milliseconds = [](SteadyClock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  };
  statistics_.located_age.Add(milliseconds(staged.times.located - staged.times.arrival));
  statistics_.staged_age.Add(milliseconds(staged.times.staged - staged.times.arrival));
  statistics_.drawn_age.Add(milliseconds(drawn - staged.times.arrival));
  statistics_.shown_age.Add(milliseconds(now - staged.times.arrival));
  statistics_.total.Add(milliseconds(now - staged.times.arrival));
  if (drawn_frames_ == 0) {
    statistics_.startup_seconds = Seconds(now);
  } else {
    statistics_.interval.Add(milliseconds(now - last_shown_));
  }
  last_shown_ = now;
  ++drawn_frames_;
}

// Called also between two images of the camera.
Status ShowSession::ServeOpenXr() {
  if (openxr_ != nullptr) {
    LARARIUM_ASSIGN_OR_RETURN(const bool more, openxr_->headset().Frame());
    if (!more) {
      log_.info("the headset's runtime ended the session");
      RequestEnd();
    }
    for (const std::string& button : openxr_->headset().TakeButtons()) {
      PressKey(button);
    }
  }
  return Status();
}

Status ShowSession::DrawPicture(const show::StagedFrame& staged) {
  if (openxr_ != nullptr) {
    return openxr_->Draw(staged, *renderer_, *target_, Seconds(SteadyClock::now()), Shown(),
                         [this](const geometry::CameraModel& eye) { ShowMenuTo(eye); });
  }
  return stereo_ ? stereo_->Draw(staged, *renderer_, *target_) : renderer_->Draw(staged, *target_);
}

Status ShowSession::DrawFrame(show::StagedFrame& staged) {
  if (kiosk_) {
    kiosk_->BeforeFrame(staged);
  }
  drama_time_ = staged.time;
  if (options_.staff) {
    ShowToStaff();
  }
  ShowMenu(staged);
  if (draw_ms_ > kSlowPicture) {
    heartbeat_.BeatBeforeLongWork();
  }
  const SteadyClock::time_point begin = SteadyClock::now();
  SteadyClock::time_point drawn;
  {
    const ScopedStageTimer timer(statistics_.render);
    LARARIUM_RETURN_IF_ERROR(DrawPicture(staged));
    target_->Finish();
    drawn = SteadyClock::now();
    screen_->Present(shown());
  }
  if (sound_ != nullptr) {
    sound_->Show(staged.sound);
  }
  AddTimes(staged, drawn);
  faults_.AfterFrame(staged.tracked);
  draw_ms_ = std::chrono::duration<double, std::milli>(drawn - begin).count();
  ChooseQuality(last_shown_, staged, std::max(draw_ms_, staged.times.stage_ms));
  heartbeat_.Beat();
  AfterFrame(staged);
  TellStaff(staged);
  if (drawn_frames_ == kFirstFrames) {
    render::ReleaseShaderCompiler();
    heap_keeper_.emplace(kKeepInterval);
  }
  return recorder_->Add(staged, shown());
}

Status ShowSession::RunLockStep() {
  std::optional<show::LockStep> lock_step(std::in_place, stages());
  show::StagedFrame staged;
  while (KeepGoing()) {
    if (OtherLanguagesAreReady()) {
      lock_step.reset();
      LARARIUM_RETURN_IF_ERROR(ChangeLanguages());
      lock_step.emplace(stages());
    }
    LARARIUM_ASSIGN_OR_RETURN(const bool more, lock_step->Next(staged));
    if (!more) {
      break;
    }
    LARARIUM_RETURN_IF_ERROR(DrawFrame(staged));
    LARARIUM_RETURN_IF_ERROR(ServeOpenXr());
  }
  return Status();
}

Status ShowSession::RunRealtime() {
  std::optional<show::RealtimePipeline> pipeline(std::in_place, stages());
  while (!pipeline->Finished() && KeepGoing(pipeline->LongestWork())) {
    if (OtherLanguagesAreReady()) {
      pipeline.reset();
      LARARIUM_RETURN_IF_ERROR(ChangeLanguages());
      pipeline.emplace(stages());
    }
    LARARIUM_RETURN_IF_ERROR(ServeOpenXr());
    // With a headset, ServeOpenXr has waited for the display already.
    const auto wait = openxr_ != nullptr ? std::chrono::milliseconds(0) : kInputInterval;
    if (std::unique_ptr<show::StagedFrame> staged = pipeline->Take(wait)) {
      LARARIUM_RETURN_IF_ERROR(DrawFrame(*staged));
      pipeline->Recycle(std::move(staged));
    }
  }
  pipeline->Stop();
  return pipeline->status();
}

Status ShowSession::Run() {
  LARARIUM_RETURN_IF_ERROR(options_.pace == Pace::kFast ? RunLockStep() : RunRealtime());
  if (openxr_ != nullptr) {
    LARARIUM_RETURN_IF_ERROR(openxr_->headset().End());
  }
  LARARIUM_RETURN_IF_ERROR(recorder_->Finish());
  if (quality_) {
    statistics_.quality = quality_->ToJson();
  }
  if (!options_.stats_out.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveJson(options_.stats_out, statistics_.ToJson()));
  }
  if (!options_.visitor_log.empty()) {
    LARARIUM_RETURN_IF_ERROR(
        WriteFileAtomically(options_.visitor_log, show_->drama().visitor_log().Write()));
  }
  log_.info("{} frames shown, {:.1f} % tracked", drawn_frames_,
            100.0 * statistics_.tracking.tracked_fraction());
  return begin_again_ ? Status::Error("staff page", "the staff asked to restart the player")
                      : Status();
}

}  // namespace lararium::player
