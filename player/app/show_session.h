#pragma once

// One run of a show. Private to play.cc. show_session.cc has the loop that draws each picture;
// show_session_prepare.cc opens and loads everything, and changes languages;
// show_session_visitor.cc handles the requests of visitors and staff.

#include <chrono>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "player/app/device_file.h"
#include "player/app/gaze_menu.h"
#include "player/app/options.h"
#include "player/app/osc.h"
#include "player/app/recorder.h"
#include "player/app/screen.h"
#include "player/app/show_maker.h"
#include "player/app/stereo_display.h"
#include "player/app/visitor_menu.h"
#include "player/kiosk/fault_log.h"
#include "player/kiosk/kiosk.h"
#include "player/kiosk/power_sensors.h"
#include "player/kiosk/watchdog.h"
#include "player/openxr/headset.h"
#include "player/openxr/openxr_display.h"
#include "player/staff/staff_reporter.h"
#include "shared/audio/sound_player.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/memory.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/quality.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/quality_controller.h"
#include "shared/show/show.h"
#include "shared/show/show_renderer.h"
#include "shared/show/show_statistics.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

using SteadyClock = std::chrono::steady_clock;

// Asks the running session to end. Signal handlers may call it.
void RequestEnd();

// The quality at a level of render::QualityLadder(); the last one for larger levels.
const render::Quality& QualityOf(size_t level);

// Owns everything that lives from the first frame of a run to the last.
class ShowSession {
 public:
  ShowSession(const PlayOptions& options,
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
  // longest_work: see RealtimePipeline.
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
  // The argument `finest` of show::LoadShowContent.
  float FinestDetail() const;
  Status ChooseView(const show::ShowContent& content);
  Status CreateTracker(const show::ShowContent& content);
  void TellKiosk();
  void TellShow();
  // Factor on volume and visibility, which falls to 0 when a visit is over.
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
  int restarts_;               // number of restarts before this run
  bool begin_again_ = false;   // the staff asked the watchdog to restart the show
  double story_length_ = 0.0;  // seconds; 0: not known
  int64_t told_statistics_ = -1;
  Choices choices_;
  Choices house_;                         // defaults set by the staff for a kiosk's next visitor
  show::LanguageChoice shown_languages_;  // the choice that show_ was created for
  GazeMenu menu_;
  double drama_time_ = 0.0;  // drama time of the last frame that was drawn, seconds
  Device device_;
  std::optional<Headset> headset_;  // nullopt: the show is not shown on a headset
  geometry::CameraModel camera_;
  show::ViewPart part_;  // the part of the camera's view that is drawn
  PictureSize size_;
  std::unique_ptr<capture::FrameSource> source_;
  std::unique_ptr<vision::PoseSource> poses_;
  ShowMaker maker_;
  std::unique_ptr<show::Show> show_;
  std::optional<Screen> screen_;  // declared before everything that draws, so destroyed after it
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  std::optional<StereoDisplay> stereo_;
  std::unique_ptr<OpenXrDisplay> openxr_;  // nullptr: no OpenXR headset
  std::optional<StaffReporter> staff_;     // nullopt: no staff page
  std::optional<Recorder> recorder_;
  std::optional<HeapKeeper> heap_keeper_;      // set after the first pictures
  std::unique_ptr<audio::SoundPlayer> sound_;  // nullptr: no sound
  std::unique_ptr<OscListener> osc_;           // nullptr: no OSC
  std::optional<show::QualityController> quality_;
  std::optional<PowerWatch> power_;  // set if the quality is adapted
  show::ShowStatistics statistics_;
  SteadyClock::time_point last_shown_;
  double draw_ms_ = 0.0;  // drawing time of the last picture
  int64_t drawn_frames_ = 0;
  // The show in other languages that is being created, and its languages. Declared last, because
  // its thread uses the members above.
  show::LanguageChoice next_languages_;
  std::future<Result<std::unique_ptr<show::Show>>> next_show_;
};

}  // namespace lararium::player
