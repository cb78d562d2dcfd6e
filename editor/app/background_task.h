#pragma once

// Long work beside the interface: it reports progress, can be cancelled, and
// ends with a Status that the interface thread collects.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// Seconds until work is done that reached fraction after elapsed seconds;
// nullopt while too little is done to tell.
std::optional<double> EstimateSecondsLeft(double fraction, double elapsed_seconds);

// "40 s", "3 min 20 s", "1 h 5 min".
std::string FormatDuration(double seconds);

class BackgroundTask {
 public:
  using Work = std::function<Status(Progress&)>;

  struct State {
    std::string step;
    double fraction = 0.0;  // of the step
    double step_seconds = 0.0;
    bool cancelling = false;
  };

  // Starts at once.
  BackgroundTask(std::string name, Work work);
  // Cancels and waits.
  ~BackgroundTask() { Cancel(); }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  const std::string& name() const { return name_; }
  State state() const;
  void Cancel() { cancelled_ = true; }
  bool cancelled() const { return cancelled_; }

  // The outcome, once there is one.
  std::optional<Status> outcome() const;

 private:
  class Reporter;

  std::string name_;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  std::string step_;
  double fraction_ = 0.0;
  std::chrono::steady_clock::time_point step_start_ = std::chrono::steady_clock::now();
  std::optional<Status> outcome_;
  std::jthread thread_;  // last: joined before the rest goes
};

// The tasks that run at the moment. Used from one thread, the interface's.
class TaskList {
 public:
  // done: called by Poll() after the work has ended; cancelled tells the two
  // kinds of failure apart.
  using Done = std::function<void(const Status& status, bool cancelled)>;

  // False where a task of that name runs already.
  bool Start(const std::string& name, BackgroundTask::Work work, Done done);
  bool Running(const std::string& name) const;
  void Cancel(const std::string& name);

  // Collects what has ended.
  void Poll();

  struct Entry {
    std::unique_ptr<BackgroundTask> task;
    Done done;
  };
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace lararium::app
