#pragma once

// One run of a show, from opening everything to the last picture. Private to play.cc.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "player/app/camera_choice.h"
#include "player/app/device_file.h"
#include "player/app/options.h"
#include "player/app/osc.h"
#include "player/app/picture_output.h"
#include "player/app/play.h"
#include "player/app/quality_control.h"
#include "player/app/recorder.h"
#include "player/app/show_maker.h"
#include "player/app/visitor_controls.h"
#include "player/kiosk/fault_log.h"
#include "player/kiosk/watchdog.h"
#include "player/staff/staff_reporter.h"
#include "shared/audio/sound_player.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/memory.h"
#include "shared/core/status.h"
#include "shared/group/group_feed.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/show.h"
#include "shared/show/show_statistics.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

using SteadyClock = std::chrono::steady_clock;

// Asks the running session to end. Signal handlers may call it.
void RequestEnd();

// Owns everything that lives from the first frame of a run to the last.
class ShowSession {
 public:
  ShowSession(const PlayOptions& options,
              SteadyClock::time_point started,
              Log& log,
              const PlayLinks& links);

  // Opens and loads everything.
  Status Prepare();
  // Plays the show until its end.
  Result<PlayEnd> Run();

 private:
  // Preparing.
  Result<show::ShowContent> LoadInChosenLanguages();
  Result<CameraChoice> ChooseCamera(const show::ShowContent& content) const;
  Status CreateTracker(const show::ShowContent& content, const CameraChoice& camera);
  Status PrepareDrawing(const show::ShowContent& content, const PictureLayout& layout);
  void OpenSound();

  // Logs what is to be known of the camera's source, from note `first` on.
  void TellNotes(size_t first);

  // The loop.
  Status RunLockStep();
  Status RunRealtime();
  // longest_work: see RealtimePipeline.
  bool KeepGoing(double longest_work = 0.0);
  // Whether a newer show waits and no visitor would see the change.
  bool Outdated();
  void TakeInput();
  Status DrawFrame(show::StagedFrame& staged);
  Status ServeOpenXr();
  void AddTimes(const show::StagedFrame& staged, SteadyClock::time_point drawn);
  void TellStaff(const show::StagedFrame& staged);
  Status JoinGroup(const show::ShowContent& content);
  void ShowTracking();
  void SetVolume();
  void ApplyQuality();
  bool OtherLanguagesAreReady();
  Status ChangeLanguages();

  show::FrameStages stages() { return {*source_, *poses_, *show_, statistics_}; }
  double Seconds(SteadyClock::time_point time) const {
    return std::chrono::duration<double>(time - started_).count();
  }
  double Now() const { return Seconds(SteadyClock::now()); }
  bool lock_step() const { return options_.pace == Pace::kFast; }
  // The argument `finest` of show::LoadShowContent.
  float FinestDetail() const;

  const PlayOptions& options_;
  SteadyClock::time_point started_;
  Log& log_;
  FaultLog faults_;
  Heartbeat heartbeat_;
  int restarts_;  // Number of restarts before this run.
  QualityControl quality_;
  Device device_;
  std::unique_ptr<capture::FrameSource> source_;
  std::unique_ptr<vision::PoseSource> poses_;
  std::optional<group::GroupFeed> feed_;  // nullopt: the show plays alone.
  std::unique_ptr<show::Show> show_;
  std::unique_ptr<PictureOutput> output_;
  std::optional<VisitorControls> controls_;  // The constructor always sets it.
  std::optional<StaffReporter> staff_;       // nullopt: neither a staff page nor a fleet.
  UpdateWatch* updates_;                     // nullptr: no updates
  std::function<void()> look_for_update_;    // Empty: no updates.
  int64_t told_statistics_ = -1;
  std::optional<Recorder> recorder_;
  std::optional<HeapKeeper> heap_keeper_;      // Set after the first pictures.
  std::unique_ptr<audio::SoundPlayer> sound_;  // nullptr: no sound
  std::unique_ptr<OscListener> osc_;           // nullptr: no OSC
  show::ShowStatistics statistics_;
  SteadyClock::time_point last_shown_;
  double drama_time_ = 0.0;  // Drama time of the last frame that was drawn, seconds.
  double draw_ms_ = 0.0;     // Drawing time of the last picture.
  int64_t drawn_frames_ = 0;
  ShowMaker maker_;  // Declared last, because its thread writes to the log that staff_ reads.
};

}  // namespace lararium::player
