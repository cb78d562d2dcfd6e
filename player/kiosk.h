#pragma once

// A show that stands in a museum: for one visitor after the other, each from its beginning; after
// a failure it goes on where it was.

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "player/kiosk_state.h"
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

  // What the last visitor chose: of the show that it names.
  const KioskState& state() const { return state_; }
  // Where to go on with a show; 0: at its beginning.
  double ResumeAt(const std::string& title) const;

  // After a frame was shown, seconds by a steady clock. Begins the show anew for the next visitor,
  // and keeps where it is.
  void AfterFrame(double now, const show::StagedFrame& staged, show::Show& show);

  // A key was pressed: somebody is there. Who just came sees the show from its beginning.
  void Touch(double now, show::Show& show);
  // What a visitor chose.
  void Keep(const Choices& choices, double now);

 private:
  void Remember(double now);

  Log& log_;
  KioskState state_;
  bool fresh_ = false;  // the state's time is not to be believed
  VisitorWatch watch_;
  double remembered_ = -1e9;  // when the state was handed to the writer
  Mailbox<KioskState> to_write_;
  std::jthread writer_;  // disks are slow
};

}  // namespace lararium::player
