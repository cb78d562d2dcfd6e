#pragma once

// A show that stands in a museum: for one visitor after the other, each from its beginning; after
// a failure it goes on where it was.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "player/kiosk_state.h"
#include "player/visit_budget.h"
#include "player/visit_statistics.h"
#include "player/visitor_watch.h"
#include "player/watchdog.h"
#include "shared/core/log.h"
#include "shared/core/mailbox.h"
#include "shared/show/show.h"

namespace lararium::player {

// The folder where a kiosk keeps its state unless told otherwise (XDG Base Directory).
std::filesystem::path DefaultStateFolder();

class Kiosk {
 public:
  // A state that cannot be read is a new one, and the log says so. start: after failed starts the
  // show begins at its beginning: what is there may be what fails.
  Kiosk(std::filesystem::path folder, const ChildStart& start, Log& log);
  // Writes what it has counted, and where the show is.
  ~Kiosk();
  Kiosk(const Kiosk&) = delete;
  Kiosk& operator=(const Kiosk&) = delete;

  // What the last visitor chose: of the show that it names.
  const KioskState& state() const { return state_; }
  // Where to go on with a show; 0: at its beginning.
  double ResumeAt(const std::string& title) const;

  // How long a visit may take.
  void SetVisit(const VisitOptions& options) { visit_ = VisitBudget(options); }
  // Seconds after which the story of the show is told; 0: not known.
  void SetStoryLength(double seconds) { story_length_ = seconds; }

  // Before a frame is drawn: nobody is left in it when the visit is over.
  void BeforeFrame(show::StagedFrame& staged) const;
  // How much of people is seen, and of what is chosen to be heard: less when the visit is over.
  float shown() const { return visit_.shown(); }
  // After a frame was shown, seconds by a steady clock. Begins the show anew for the next visitor,
  // keeps where it is and counts.
  void AfterFrame(double now, const show::StagedFrame& staged, show::Show& show);

  // A key was pressed: somebody is there. Who just came sees the show from its beginning.
  void Touch(double now, show::Show& show);
  // The show from its beginning, because somebody asked for it: after the end of a visit it is
  // the next one.
  void BeginAgain(double now, show::Show& show);
  // What a visitor chose, and how the next is to find it.
  void Keep(const Choices& choices, const Choices& house, double now);
  // Once for each visitor: what the one before chose is not theirs.
  bool TakeNewVisitor() { return std::exchange(new_visitor_, false); }

  // Whether somebody is there.
  bool visited() const { return watch_.noticed(); }
  const VisitStatistics& statistics() const { return statistics_; }
  // Grows when they are written down.
  int64_t statistics_version() const { return statistics_version_; }

 private:
  void Write(const std::filesystem::path& folder);
  void SaveStatistics(const std::filesystem::path& folder, bool& told);
  void Count(double now, const show::StagedFrame& staged);
  void KeepStatistics(double now);
  void Remember(double now);
  void Welcome(double now, show::Show& show);

  Log& log_;
  KioskState state_;
  bool fresh_ = false;  // the state's time is not to be believed
  VisitorWatch watch_;
  VisitBudget visit_;
  bool new_visitor_ = false;
  double remembered_ = -1e9;  // when the state was handed to the writer
  Mailbox<KioskState> to_write_;
  VisitStatistics statistics_;
  VisitCounter counter_;
  double story_length_ = 0.0;
  std::string today_;
  bool was_noticed_ = false;
  double kept_statistics_ = -1e9;  // when they were handed to the writer
  int64_t statistics_version_ = 0;
  Mailbox<VisitStatistics> statistics_to_write_;
  std::jthread writer_;  // disks are slow
};

}  // namespace lararium::player
