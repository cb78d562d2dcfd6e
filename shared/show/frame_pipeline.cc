#include "shared/show/frame_pipeline.h"

#include <algorithm>
#include <utility>

#include "shared/core/sleep.h"

namespace lararium::show {
namespace {

using Clock = std::chrono::steady_clock;

Result<std::optional<geometry::Frame>> TimedNext(const FrameStages& stages) {
  const ScopedStageTimer timer(stages.statistics.capture);
  return stages.source.Next();
}

vision::TrackedFrame TimedTrack(const FrameStages& stages, const geometry::Frame& frame) {
  const ScopedStageTimer timer(stages.statistics.track);
  return stages.poses.Track(frame);
}

void TimedStage(const FrameStages& stages,
                vision::TrackedFrame tracked,
                double time,
                StagedFrame& staged) {
  const Clock::time_point begin = Clock::now();
  {
    ScopedStageTimer timer(stages.statistics.simulate);
    stages.show.StageFrame(std::move(tracked), time, staged);
    timer.AddCpu(staged.times.helpers_cpu_ms);
  }
  staged.times.staged = Clock::now();
  staged.times.stage_ms =
      std::chrono::duration<double, std::milli>(staged.times.staged - begin).count();
}

}  // namespace

LockStep::LockStep(FrameStages stages)
    : stages_(stages), thread_([this](const std::stop_token& stop) {
        while (std::optional<StagedFrame> staged = wanted_.Take(stop)) {
          Result<bool> more = Prepare(*staged);
          prepared_.Put({std::move(more), std::move(*staged)});
        }
      }) {
  wanted_.Put({});
}

LockStep::~LockStep() {
  thread_.request_stop();
  thread_.join();
}

Result<bool> LockStep::Prepare(StagedFrame& staged) {
  LARARIUM_ASSIGN_OR_RETURN(const std::optional<geometry::Frame> frame, TimedNext(stages_));
  if (!frame) {
    return false;
  }
  staged.times.arrival = Clock::now();
  vision::TrackedFrame tracked = TimedTrack(stages_, *frame);
  staged.times.located = Clock::now();
  TimedStage(stages_, std::move(tracked), clock_.ShowTime(*frame), staged);
  return true;
}

Result<bool> LockStep::Next(StagedFrame& staged) {
  if (more_.ok() && *more_) {
    Prepared prepared = *prepared_.Take(std::stop_token());
    more_ = std::move(prepared.more);
    if (more_.ok() && *more_) {
      std::swap(staged, prepared.staged);
      stages_.statistics.tracking.Add(staged.tracked);
      wanted_.Put(std::move(prepared.staged));
    }
  }
  return more_;
}

class RealtimePipeline::Work {
 public:
  Work(RealtimePipeline& pipeline, Worker worker) : since_(pipeline.work_since_[worker]) {
    since_.store(Clock::now().time_since_epoch().count(), std::memory_order_relaxed);
  }
  ~Work() { since_.store(0, std::memory_order_relaxed); }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

 private:
  std::atomic<int64_t>& since_;
};

RealtimePipeline::RealtimePipeline(FrameStages stages)
    : stages_(stages),
      capture_thread_([this](const std::stop_token& stop) { Capture(stop); }),
      track_thread_([this](const std::stop_token& stop) { Track(stop); }),
      simulate_thread_([this](const std::stop_token& stop) { Simulate(stop); }) {}

RealtimePipeline::~RealtimePipeline() { Stop(); }

void RealtimePipeline::Stop() {
  if (!capture_thread_.joinable()) {
    return;  // Already stopped.
  }
  for (std::jthread* thread : {&capture_thread_, &track_thread_, &simulate_thread_}) {
    thread->request_stop();
  }
  for (std::jthread* thread : {&capture_thread_, &track_thread_, &simulate_thread_}) {
    thread->join();
  }
  stages_.statistics.dropped_frames += captured_.dropped() + located_.dropped() + staged_.dropped();
}

Status RealtimePipeline::status() const {
  const std::lock_guard lock(status_mutex_);
  return status_;
}

double RealtimePipeline::LongestWork() const {
  const Clock::duration now = Clock::now().time_since_epoch();
  Clock::duration longest(0);
  for (const std::atomic<int64_t>& since : work_since_) {
    if (const int64_t began = since.load(std::memory_order_relaxed); began != 0) {
      longest = std::max(longest, now - Clock::duration(began));
    }
  }
  return std::chrono::duration<double>(longest).count();
}

std::unique_ptr<StagedFrame> RealtimePipeline::Take(std::chrono::milliseconds timeout) {
  return staged_.TakeFor(timeout).value_or(nullptr);
}

void RealtimePipeline::Recycle(std::unique_ptr<StagedFrame> staged) {
  staged->tracked.frame = {};  // Release the image's buffer for reuse.
  const std::lock_guard lock(spare_mutex_);
  spare_.push_back(std::move(staged));
}

std::unique_ptr<StagedFrame> RealtimePipeline::SpareFrame() {
  const std::lock_guard lock(spare_mutex_);
  if (spare_.empty()) {
    return std::make_unique<StagedFrame>();
  }
  std::unique_ptr<StagedFrame> spare = std::move(spare_.back());
  spare_.pop_back();
  return spare;
}

void RealtimePipeline::Capture(const std::stop_token& stop) {
  const Clock::time_point start = Clock::now();
  FrameClock clock;
  while (!stop.stop_requested()) {
    Result<std::optional<geometry::Frame>> next = TimedNext(stages_);
    if (!next.ok()) {
      const std::lock_guard lock(status_mutex_);
      status_ = next.status();
      break;
    }
    if (!*next) {
      break;
    }
    if (!stages_.source.live()) {
      const std::chrono::duration<double> due(clock.ShowTime(**next));
      SleepUntil(start + std::chrono::duration_cast<Clock::duration>(due), stop);
    }
    captured_.Put({std::move(**next), Clock::now()});
  }
  captured_.Close();
}

void RealtimePipeline::Track(const std::stop_token& stop) {
  while (std::optional<CapturedFrame> captured = captured_.Take(stop)) {
    const Work work(*this, kTracks);
    vision::TrackedFrame tracked = TimedTrack(stages_, captured->frame);
    located_.Put({std::move(tracked), captured->arrival, Clock::now()});
  }
  located_.Close();
}

void RealtimePipeline::Simulate(const std::stop_token& stop) {
  FrameClock clock;
  while (std::optional<LocatedFrame> located = located_.Take(stop)) {
    const Work work(*this, kStages);
    std::unique_ptr<StagedFrame> staged = SpareFrame();
    staged->times.arrival = located->arrival;
    staged->times.located = located->located;
    const double time = clock.ShowTime(located->tracked.frame);
    stages_.statistics.tracking.Add(located->tracked);
    TimedStage(stages_, std::move(located->tracked), time, *staged);
    if (std::optional<std::unique_ptr<StagedFrame>> skipped = staged_.Put(std::move(staged))) {
      Recycle(std::move(*skipped));
    }
  }
  staged_.Close();
}

}  // namespace lararium::show
