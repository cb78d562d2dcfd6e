#pragma once

// Keeps a show running in a child process, which regularly reports that it is alive. If it fails or
// stops reporting, it is replaced by a new one.

#include <cstdint>
#include <functional>

#include "shared/core/log.h"

namespace lararium::player {

// The child's side: reports that it is alive.
class Heartbeat {
 public:
  explicit Heartbeat(int descriptor = -1) : descriptor_(descriptor) {}
  // Cheap enough to be called for every frame. Does nothing without a watchdog.
  void Beat();
  // Announces that the work until the next beat may take as long as a start, for example because
  // shaders are compiled.
  void BeatBeforeLongWork();

 private:
  void Say(char beat);

  int descriptor_;  // -1: there is no watchdog
  int64_t last_ms_ = 0;
};

struct WatchdogOptions {
  double start_seconds = 20.0;  // limit until the first beat, and for long work
  // A child without a beat for this time counts as hanging. The time doubles with each consecutive
  // child that failed at its start, up to start_seconds: the machine may be slow or busy.
  double silent_seconds = 1.0;
  double grace_seconds = 1.0;  // time that a child has to end after it was asked
  // A child that ran for less than this after its first beat has failed at its start. The next one
  // starts after a pause, which grows each time.
  double stable_seconds = 10.0;
  double first_pause_seconds = 0.0;
  double longest_pause_seconds = 10.0;
};

// Information for a child about the children before it.
struct ChildStart {
  int number = 0;         // number of children before this one
  int failed_starts = 0;  // consecutive children before this one that failed at their start
};

// Exit code of a wrong command line. A child that returns it is not started again.
inline constexpr int kUsageError = 2;
// A child that returns this is started again, and has not failed.
inline constexpr int kStartAgain = 3;

// Runs child in a process of its own, again and again, until it returns 0 or kUsageError, or
// this process gets SIGINT or SIGTERM, which ends the child too. Returns the exit code of the last
// child. Notifies systemd, if it listens, that the service is ready. Must be called while there is
// one thread.
int Supervise(const std::function<int(const ChildStart&, Heartbeat&)>& child,
              const WatchdogOptions& options,
              Log& log);

}  // namespace lararium::player
