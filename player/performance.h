#pragma once

// One run of a show, private to play.cc. performance.cc: each picture; performance_prepare.cc: what
// is opened and loaded, once or for other languages; performance_visitor.cc: what the visitor and
// staff want.

#include <chrono>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "player/device_file.h"
#include "player/fault_log.h"
#include "player/gaze_menu.h"
#include "player/headset.h"
#include "player/kiosk.h"
#include "player/openxr_display.h"
#include "player/options.h"
#include "player/osc.h"
#include "player/power_sensors.h"
#include "player/recorder.h"
#include "player/screen.h"
#include "player/show_maker.h"
#include "player/staff_reporter.h"
#include "player/stereo_display.h"
#include "player/visitor_menu.h"
#include "player/watchdog.h"
#include "shared/audio/sound_player.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/memory.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/quality.h"
#include "shared/render/render_target.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/quality_controller.h"
#include "shared/show/show.h"
#include "shared/show/show_renderer.h"
#include "shared/show/show_statistics.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

using SteadyClock = std::chrono::steady_clock;

// Lets whatever performance runs end. Signal handlers may call it.
void RequestEnd();

// Of the ladder; the last one for levels beyond it.
const render::Quality& QualityOf(size_t level);

// All that lives from a run's first frame to its last.
class Performance {
 public:
  Performance(const PlayOptions& options,
              SteadyClock::time_point started,
              Log& log,
              const ChildStart& start,
              Heartbeat heartbeat,
              int staff_link);

  Status Prepare();
  Status Run();

 private:
  show::FrameStages stages() { return {*source_, *poses_, *show_, statistics_}; }
  double Seconds(SteadyClock::time_point time) const {
    return std::chrono::duration<double>(time - started_).count();
  }
  // longest_work: as RealtimePipeline has it.
  bool KeepGoing(double longest_work = 0.0);
  void PressKeys();
  void PressKey(const std::string& key);
  void Do(Action action);
  void Change(const Choices& choices);
  void ObeyStaff();
  Offer offer() const {
    const show::ShowContent& content = show_->content();
    return {content.spoken_languages, content.caption_languages, content.has_descriptions};
  }
  void Obey(const StaffCommand& command);
  void TellStaff(const show::StagedFrame& staged);
  void FillStaffState(const show::StagedFrame& staged, StaffState& state) const;
  size_t level() const;
  void ToggleMenu();
  void ShowMenu(const show::StagedFrame& staged);
  Status OpenSource();
  void ApplyOptions(Choices& choices) const;
  show::LanguageChoice languages() const { return {choices_.language, choices_.captions}; }
  Result<show::ShowContent> LoadInChosenLanguages();
  Status ChooseHeadset();
  // As show::LoadShowContent takes it.
  float FinestDetail() const;
  Status ChooseView(const show::ShowContent& content);
  Status CreateTracker(const show::ShowContent& content);
  void TellKiosk();
  void TellShow();
  // How much is heard and seen of a visit that may be over.
  float Shown() const { return kiosk_ ? kiosk_->shown() : 1.0f; }
  void SetVolume();
  Status PrepareDrawing(const show::ShowContent& content);
  void BeginChangingLanguages();
  bool OtherLanguagesAreReady();
  Status ChangeLanguages();
  void ChooseFirstLevel();
  void OpenSound();
  Status RunLockStep();
  Status RunRealtime();
  Status DrawPicture(const show::StagedFrame& staged);
  void ShowMenuTo(const geometry::CameraModel& picture);
  Status ServeOpenXr();
  const render::RenderTarget& shown() const { return stereo_ ? stereo_->panel() : *target_; }
  Status DrawFrame(show::StagedFrame& staged);
  void AfterFrame(const show::StagedFrame& staged);
  void AddTimes(const show::StagedFrame& staged, SteadyClock::time_point drawn);
  void ChooseQuality(SteadyClock::time_point now, const show::StagedFrame& staged, double work_ms);
  void SetLevel(size_t level);
  void ShowToStaff();

  const PlayOptions& options_;
  SteadyClock::time_point started_;
  Log& log_;
  FaultLog faults_;
  Heartbeat heartbeat_;
  std::optional<Kiosk> kiosk_;
  int restarts_;               // before this run
  bool begin_again_ = false;   // the watchdog is to begin it again
  double story_length_ = 0.0;  // seconds; 0: not known
  int64_t told_statistics_ = -1;
  Choices choices_;
  Choices house_;                         // of staff: how a kiosk's next visitor finds it
  show::LanguageChoice shown_languages_;  // of show_, as they were chosen
  GazeMenu menu_;
  double drama_time_ = 0.0;  // of the frame drawn last
  Device device_;
  std::optional<Headset> headset_;  // that is shown on
  geometry::CameraModel camera_;
  show::ViewPart part_;  // of the camera's view, that is drawn
  PictureSize size_;
  std::unique_ptr<capture::FrameSource> source_;
  std::unique_ptr<vision::PoseSource> poses_;
  ShowMaker maker_;
  std::unique_ptr<show::Show> show_;
  std::optional<Screen> screen_;  // before all that draws: destroyed after it
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  std::optional<StereoDisplay> stereo_;
  std::unique_ptr<OpenXrDisplay> openxr_;  // nullptr: there is no such headset
  std::optional<StaffReporter> staff_;     // none: there is no page for staff
  std::optional<Recorder> recorder_;
  std::optional<HeapKeeper> heap_keeper_;      // from when the first pictures were shown
  std::unique_ptr<audio::SoundPlayer> sound_;  // nullptr: nothing is heard
  std::unique_ptr<OscListener> osc_;           // nullptr: nobody listens
  std::optional<show::QualityController> quality_;
  std::optional<PowerWatch> power_;  // where the quality is not fixed
  show::ShowStatistics statistics_;
  SteadyClock::time_point last_shown_;
  double draw_ms_ = 0.0;  // of the last picture
  int64_t drawn_frames_ = 0;
  // A show in other languages, and which, while it is made. Last: it makes use of what is above.
  show::LanguageChoice next_languages_;
  std::future<Result<std::unique_ptr<show::Show>>> next_show_;
};

}  // namespace lararium::player
