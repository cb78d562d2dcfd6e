#pragma once

// The way of a frame from its source to whoever draws it, in two paces: lock-step
// (every frame once, in order: deterministic) and a pipeline of threads with
// mailboxes in between (real time: a slow stage drops frames, it never queues).

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/mailbox.h"
#include "shared/core/status.h"
#include "shared/show/show.h"
#include "shared/show/show_statistics.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// What the frames pass through. Borrowed; each is used by one thread at a time.
struct FrameStages {
  capture::FrameSource& source;
  vision::PoseSource& poses;
  Show& show;
  ShowStatistics& statistics;
};

// The drama's time of a frame is its capture time since the first frame's.
class FrameClock {
 public:
  double ShowTime(const geometry::Frame& frame) {
    if (!first_) {
      first_ = frame.capture_time;
    }
    return frame.capture_time - *first_;
  }

 private:
  std::optional<double> first_;
};

// Each call takes one frame through all stages. While the caller draws it the next one is prepared:
// what is done to the show in between may be seen a frame later.
class LockStep {
 public:
  explicit LockStep(FrameStages stages);
  // Waits for the frame under way; what stages names is the caller's again.
  ~LockStep();
  LockStep(const LockStep&) = delete;
  LockStep& operator=(const LockStep&) = delete;

  // False at the end of the source, and from then on; so does a failure of it stay.
  Result<bool> Next(StagedFrame& staged);

 private:
  // Fills a frame, whose buffers serve again.
  Result<bool> Prepare(StagedFrame& staged);

  struct Prepared {
    Result<bool> more;
    StagedFrame staged;
  };

  FrameStages stages_;
  FrameClock clock_;
  Mailbox<StagedFrame> wanted_;  // to be filled
  Mailbox<Prepared> prepared_;
  Result<bool> more_ = true;
  std::jthread thread_;
};

// Capture, tracking and simulation on a thread each; the caller draws. Recorded
// sources are played at their own rate.
class RealtimePipeline {
 public:
  explicit RealtimePipeline(FrameStages stages);
  // Stops the threads and waits for them.
  ~RealtimePipeline();
  RealtimePipeline(const RealtimePipeline&) = delete;
  RealtimePipeline& operator=(const RealtimePipeline&) = delete;

  // The newest frame that is ready to be drawn; nullptr when none came in time.
  std::unique_ptr<StagedFrame> Take(std::chrono::milliseconds timeout);
  // Gives a drawn frame back, so that its buffers serve again.
  void Recycle(std::unique_ptr<StagedFrame> staged);

  // True when the source has ended and its last frame was taken.
  bool Finished() const { return staged_.Finished(); }
  // Why the source ended, if it failed.
  Status status() const;
  // Seconds for which one frame has been tracked, or one staged, by now, the longer of both; 0:
  // neither is. A source that waits for its camera is no work. From any thread.
  double LongestWork() const;

  // Stops early. Statistics are complete after this.
  void Stop();

 private:
  struct CapturedFrame {
    geometry::Frame frame;
    std::chrono::steady_clock::time_point arrival;
  };
  struct LocatedFrame {
    vision::TrackedFrame tracked;
    std::chrono::steady_clock::time_point arrival;
    std::chrono::steady_clock::time_point located;
  };

  enum Worker : size_t { kTracks, kStages, kWorkers };
  // Marks work while it lives.
  class Work;

  void Capture(const std::stop_token& stop);
  void Track(const std::stop_token& stop);
  void Simulate(const std::stop_token& stop);
  // One that serves again, or another.
  std::unique_ptr<StagedFrame> SpareFrame();

  FrameStages stages_;
  Mailbox<CapturedFrame> captured_;
  Mailbox<LocatedFrame> located_;
  Mailbox<std::unique_ptr<StagedFrame>> staged_;
  std::mutex spare_mutex_;
  std::vector<std::unique_ptr<StagedFrame>> spare_;  // drawn, or skipped for newer ones
  mutable std::mutex status_mutex_;
  Status status_;
  // When the work under way began, ticks of the steady clock; 0: there is none.
  std::array<std::atomic<int64_t>, kWorkers> work_since_ = {};
  std::jthread capture_thread_;
  std::jthread track_thread_;
  std::jthread simulate_thread_;
};

}  // namespace lararium::show
