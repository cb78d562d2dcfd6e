#pragma once

// A show in a museum. It is played for one visitor after another, from the beginning for each.
// After a failure it continues where it was.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "player/kiosk/kiosk_state.h"
#include "player/kiosk/visit_budget.h"
#include "player/kiosk/visit_statistics.h"
#include "player/kiosk/visitor_watch.h"
#include "player/kiosk/watchdog.h"
#include "shared/core/log.h"
#include "shared/core/mailbox.h"
#include "shared/show/show.h"

namespace lararium::player {

// The default folder for the state of a kiosk (XDG Base Directory).
std::filesystem::path DefaultStateFolder();

class Kiosk {
 public:
  // If the state cannot be read, the log says so and a new state is used. start: after failed
  // starts the show is not resumed, because the moment at which it stood may cause the failure.
  Kiosk(std::filesystem::path folder, const ChildStart& start, Log& log);
  // Writes the statistics and the position of the show.
  ~Kiosk();
  Kiosk(const Kiosk&) = delete;
  Kiosk& operator=(const Kiosk&) = delete;

  // The choices of the last visitor and the position, which belong to the show that it names.
  const KioskState& state() const { return state_; }
  // Drama time at which a show is resumed, seconds; 0: the beginning.
  double ResumeAt(const std::string& title) const;

  // Sets the time limit of visits.
  void SetVisit(const VisitOptions& options) { visit_ = VisitBudget(options); }
  // Length of the show's story in seconds; 0: unknown.
  void SetStoryLength(double seconds) { story_length_ = seconds; }

  // Call this before a frame is drawn. When the visit is over, people fade out of the frame and the
  // farewell is shown.
  void BeforeFrame(show::StagedFrame& staged) const;
  // Factor on the visibility of people and on the volume, 0..1; it falls when the visit is over.
  float shown() const { return visit_.shown(); }
  // Call this after a frame was shown. now: seconds of a steady clock. Restarts the show for the
  // next visitor, saves the position and updates the statistics.
  void AfterFrame(double now, const show::StagedFrame& staged, show::Show& show);

  // Call this when a key was pressed, so a visitor is present. For a new visitor the show starts
  // from the beginning.
  void Touch(double now, show::Show& show);
  // Restarts the show on request. If the visit was over, this begins the next one.
  void BeginAgain(double now, show::Show& show);
  // Saves the choices of the visitor, and the defaults (house) for the next one.
  void Keep(const Choices& choices, const Choices& house, double now);
  // True once for each new visitor, for whom choices must be reset to the defaults.
  bool TakeNewVisitor() { return std::exchange(new_visitor_, false); }

  // True if a visitor is present.
  bool visited() const { return watch_.noticed(); }
  const VisitStatistics& statistics() const { return statistics_; }
  // Grows whenever the statistics are saved.
  int64_t statistics_version() const { return statistics_version_; }

 private:
  void Write(const std::filesystem::path& folder);
  void SaveStatistics(const std::filesystem::path& folder, bool& told);
  void Count(double now, const show::StagedFrame& staged, const show::ShowContent& content);
  void KeepStatistics(double now);
  void Remember(double now);
  void Welcome(double now, show::Show& show);

  Log& log_;
  KioskState state_;
  bool fresh_ = false;  // the saved position must not be used
  VisitorWatch watch_;
  VisitBudget visit_;
  bool new_visitor_ = false;
  double remembered_ = -1e9;  // time when the state was last handed to the writer
  Mailbox<KioskState> to_write_;
  VisitStatistics statistics_;
  VisitCounter counter_;
  double story_length_ = 0.0;
  std::string today_;
  bool was_noticed_ = false;
  double kept_statistics_ = -1e9;  // time when statistics were last handed to the writer
  int64_t statistics_version_ = 0;
  Mailbox<VisitStatistics> statistics_to_write_;
  std::jthread writer_;  // a thread of its own, because disks are slow
};

}  // namespace lararium::player
