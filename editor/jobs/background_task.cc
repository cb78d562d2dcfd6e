#include "editor/jobs/background_task.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

#include "editor/text/text.h"
#include "shared/core/memory.h"

namespace lararium::editor {

namespace {

// The names of the kinds, in the order of TaskKind.
constexpr std::array kTaskNames = {
    TrLater("Training"),
    TrLater("Baking"),
    TrLater("Exporting"),
    TrLater("Playing the show"),
    TrLater("Opening"),
    TrLater("Measuring"),
    TrLater("Opening the cast library"),
    TrLater("Fetching the cast library"),
    TrLater("Reading the bones"),
    TrLater("Reading the light probe"),
    TrLater("Measuring the camera"),
    TrLater("Running the drama"),
    TrLater("Checking"),
    TrLater("Writing the map"),
    TrLater("Refining on the map"),
    TrLater("Speaking"),
    TrLater("Calibrating"),
    TrLater("Copying the sample"),
    TrLater("Reading the recording"),
};
static_assert(kTaskNames.size() == static_cast<size_t>(TaskKind::kFirstImage) + 1);

}  // namespace

const char* TaskName(TaskKind kind) { return kTaskNames[static_cast<size_t>(kind)]; }

std::optional<double> EstimateSecondsLeft(double fraction, double elapsed_seconds) {
  constexpr double kMinFraction = 0.02;
  constexpr double kMinSeconds = 1.0;
  if (!(fraction >= kMinFraction) || elapsed_seconds < kMinSeconds) {
    return std::nullopt;
  }
  return elapsed_seconds * (1.0 - std::min(fraction, 1.0)) / fraction;
}

std::string FormatDuration(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::clamp(seconds, 0.0, 360000.0)));
  if (whole < 60) {
    return std::to_string(whole) + " s";
  }
  if (whole < 3600) {
    return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  }
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

void StepCount::Report(std::string_view step, double fraction) {
  for (size_t i = now_; i < steps_.size(); ++i) {
    if (steps_[i].name == step) {
      now_ = i;
      of_step_ = std::clamp(fraction, 0.0, 1.0);
      return;
    }
  }
}

double StepCount::fraction() const {
  double done = 0.0;
  double all = 0.0;
  for (size_t i = 0; i < steps_.size(); ++i) {
    all += steps_[i].share;
    done += i < now_ ? steps_[i].share : i == now_ ? of_step_ * steps_[i].share : 0.0;
  }
  return all > 0.0 ? done / all : 0.0;
}

class BackgroundTask::Reporter : public Progress {
 public:
  explicit Reporter(BackgroundTask& task) : task_(task) {}

  void Report(std::string_view step, double fraction) override {
    const std::lock_guard lock(task_.mutex_);
    if (task_.step_ != step) {
      task_.step_ = step;
      task_.step_start_ = std::chrono::steady_clock::now();
    }
    task_.fraction_ = std::clamp(fraction, 0.0, 1.0);
    task_.steps_.Report(step, fraction);
  }
  bool Cancelled() const override { return task_.cancelled_; }

 private:
  BackgroundTask& task_;
};

BackgroundTask::BackgroundTask(TaskKind kind, Work work, std::vector<TaskStep> steps)
    : kind_(kind), steps_(std::move(steps)) {
  thread_ = std::jthread([this, work = std::move(work)] {
    Reporter reporter(*this);
    Status status;
    try {
      status = work(reporter);
    } catch (const std::bad_alloc&) {
      status = Status::Error(Tr(TaskName(kind_)), "the system has no more memory",
                             "close other programs and try again");
    }
    TrimHeap();  // Such work often frees much memory at its end.
    const std::lock_guard lock(mutex_);
    outcome_ = std::move(status);
  });
}

BackgroundTask::State BackgroundTask::state() const {
  const std::lock_guard lock(mutex_);
  const bool known = steps_.count() > 0;
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - (known ? start_ : step_start_);
  return {step_,           steps_.number(), steps_.count(), known ? steps_.fraction() : fraction_,
          elapsed.count(), cancelled_};
}

std::optional<Status> BackgroundTask::outcome() const {
  const std::lock_guard lock(mutex_);
  return outcome_;
}

bool TaskList::Start(TaskKind kind,
                     BackgroundTask::Work work,
                     Done done,
                     std::vector<TaskStep> steps) {
  if (Running(kind)) {
    return false;
  }
  entries_.push_back(
      {std::make_unique<BackgroundTask>(kind, std::move(work), std::move(steps)), std::move(done)});
  return true;
}

BackgroundTask* TaskList::Find(TaskKind kind) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.task->kind() == kind; });
  return found == entries_.end() ? nullptr : found->task.get();
}

void TaskList::Cancel(TaskKind kind) {
  if (BackgroundTask* task = Find(kind)) {
    task->Cancel();
  }
}

void TaskList::Poll() {
  std::vector<Entry> ended;
  for (size_t i = 0; i < entries_.size();) {
    if (entries_[i].task->outcome()) {
      ended.push_back(std::move(entries_[i]));
      entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  // The list is consistent again here, so done() may start the next task.
  for (const Entry& entry : ended) {
    entry.done(*entry.task->outcome(), entry.task->cancelled());
  }
}

}  // namespace lararium::editor
