#pragma once

// Keeps a show running: it runs in a child process that says again and again that it is alive.
// A child that ends badly, or is silent, is replaced.

#include <cstdint>
#include <functional>

#include "shared/core/log.h"

namespace lararium::player {

// The child's side: how it says that it is alive.
class Heartbeat {
 public:
  explicit Heartbeat(int descriptor = -1) : descriptor_(descriptor) {}
  // Cheap: may be called for every frame. Does nothing where nobody listens.
  void Beat();
  // What comes before the next beat may take as long as a start: shaders are compiled, say.
  void BeatBeforeLongWork();

 private:
  void Say(char beat);

  int descriptor_;  // -1: nobody listens
  int64_t last_ms_ = 0;
};

struct WatchdogOptions {
  double start_seconds = 20.0;  // until the first beat of a child, and after one before long work
  double silent_seconds = 1.0;  // between beats, before a child counts as hanging
  double grace_seconds = 1.0;   // between asking a child to end and ending it
  // A child that ran for less than this failed at its start: the next one waits, longer each time.
  double stable_seconds = 10.0;
  double first_pause_seconds = 0.0;
  double longest_pause_seconds = 10.0;
};

// What a child is told of those before it.
struct ChildStart {
  int number = 0;         // of children so far
  int failed_starts = 0;  // in a row: children that did not live for stable_seconds
};

// Runs child in a process of its own until one returns 0 (or a usage error, 2), or this process
// is asked to end (SIGINT, SIGTERM), which is passed on. Says how the last one ended. Tells
// systemd, where it listens, that the service is up. Must be called while there is one thread.
int Supervise(const std::function<int(const ChildStart&, Heartbeat&)>& child,
              const WatchdogOptions& options,
              Log& log);

}  // namespace lararium::player
