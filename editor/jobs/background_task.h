#pragma once

// Long work outside the interface thread: it reports progress, can be cancelled, and ends with a
// Status that the interface thread collects.

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

namespace lararium::editor {

// What a task does. A TaskList runs at most one task of each kind.
enum class TaskKind {
  kTraining,
  kBaking,
  kExporting,
  kTrying,
  kOpening,
  kMeasuring,
  kCatalogue,
  kFetching,
  kBoneReview,
  kProbe,
  kCamera,
  kDryRun,
  kChecking,
  kWritingMap,
  kRefining,
  kSpeaking,
  kCalibrating,
  kCopying,
  kFirstImage,
};

// The name of a kind for the interface, in English; see Tr().
const char* TaskName(TaskKind kind);

// Estimates the remaining seconds of work that has reached fraction after elapsed_seconds; nullopt
// while it is too early to estimate.
std::optional<double> EstimateSecondsLeft(double fraction, double elapsed_seconds);

// For example "40 s", "3 min 20 s", "1 h 5 min".
std::string FormatDuration(double seconds);

// A step that is known before the work begins, and its usual share of the time.
struct TaskStep {
  std::string name;  // The step name that is passed to Progress::Report.
  double share = 1.0;
};

// The overall progress of work whose steps are known and run in order. Steps may be skipped.
class StepCount {
 public:
  explicit StepCount(std::vector<TaskStep> steps = {}) : steps_(std::move(steps)) {}

  // A step that is not among the remaining ones counts as part of the current step.
  void Report(std::string_view step, double fraction);

  double fraction() const;  // Fraction of the whole work.
  int number() const { return static_cast<int>(now_) + 1; }
  int count() const { return static_cast<int>(steps_.size()); }  // 0: the steps are not known.

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
    int number = 0;  // The number of the current step, from 1.
    int count = 0;   // The number of steps; 0: not known.
    // Fraction of the whole work if its steps are known, otherwise of the current step, and the
    // seconds since that began.
    double fraction = 0.0;
    double seconds = 0.0;
    bool cancelling = false;
  };

  // Starts at once. steps: empty where they are not known.
  BackgroundTask(TaskKind kind, Work work, std::vector<TaskStep> steps = {});
  // Cancels the work and waits for its end.
  ~BackgroundTask() { Cancel(); }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  TaskKind kind() const { return kind_; }
  State state() const;
  void Cancel() { cancelled_ = true; }
  bool cancelled() const { return cancelled_; }

  // The result after the work has ended, before that nullopt.
  std::optional<Status> outcome() const;

 private:
  class Reporter;

  TaskKind kind_;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  std::string step_;
  double fraction_ = 0.0;  // Fraction of the current step.
  StepCount steps_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point step_start_ = start_;
  std::optional<Status> outcome_;
  // The last member, so that the thread is joined before the others are destroyed.
  std::jthread thread_;
};

// The running tasks. Used only from the interface thread.
class TaskList {
 public:
  // Called by Poll() after the work has ended. cancelled distinguishes a cancelled task from a
  // failed one.
  using Done = std::function<void(const Status& status, bool cancelled)>;

  // Returns false where a task of that kind is already running.
  bool Start(TaskKind kind, BackgroundTask::Work work, Done done, std::vector<TaskStep> steps = {});
  // The running task of that kind; nullptr where there is none.
  BackgroundTask* Find(TaskKind kind) const;
  bool Running(TaskKind kind) const { return Find(kind) != nullptr; }
  void Cancel(TaskKind kind);

  // Removes the tasks that have ended and calls their Done.
  void Poll();

  struct Entry {
    std::unique_ptr<BackgroundTask> task;
    Done done;
  };
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

}  // namespace lararium::editor
