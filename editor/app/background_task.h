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
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// Seconds until work is done that reached fraction after elapsed seconds;
// nullopt while too little is done to tell.
std::optional<double> EstimateSecondsLeft(double fraction, double elapsed_seconds);

// "40 s", "3 min 20 s", "1 h 5 min".
std::string FormatDuration(double seconds);

// A step of work that is known before the work begins, and its usual share of the time.
struct TaskStep {
  std::string name;  // as Progress::Report has it
  double share = 1.0;
};

// How far work is, all in all, of which steps come one after the other; some may be left out.
class StepCount {
 public:
  explicit StepCount(std::vector<TaskStep> steps = {}) : steps_(std::move(steps)) {}

  // Steps that are not among those to come count as part of the one at hand.
  void Report(std::string_view step, double fraction);

  double fraction() const;  // of all of the work
  int number() const { return static_cast<int>(now_) + 1; }
  int count() const { return static_cast<int>(steps_.size()); }  // 0: they are not known

 private:
  std::vector<TaskStep> steps_;
  size_t now_ = 0;
  double of_step_ = 0.0;
};

class BackgroundTask {
 public:
  using Work = std::function<Status(Progress&)>;

  struct State {
    std::string step;
    int number = 0;  // of the step, from 1
    int count = 0;   // of the steps; 0: they are not known
    // Of all of the work where its steps are known, otherwise of the step; and seconds since that
    // began.
    double fraction = 0.0;
    double seconds = 0.0;
    bool cancelling = false;
  };

  // Starts at once. steps: where they are known.
  BackgroundTask(std::string name, Work work, std::vector<TaskStep> steps = {});
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
  double fraction_ = 0.0;  // of the step
  StepCount steps_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point step_start_ = start_;
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
  bool Start(const std::string& name,
             BackgroundTask::Work work,
             Done done,
             std::vector<TaskStep> steps = {});
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
