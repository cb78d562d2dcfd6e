#pragma once

// Moves frames from their source to the caller that draws them, in one of two ways: in lock step
// (every frame once, in order: deterministic), or through a pipeline of threads with mailboxes in
// between (real time: a slow stage drops frames and never queues them).

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

// The stages that frames pass through. Borrowed; each is used by one thread at a time.
struct FrameStages {
  capture::FrameSource& source;
  vision::PoseSource& poses;
  Show& show;
  ShowStatistics& statistics;
};

// Maps a frame's capture time to show time: seconds since the first frame.
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

// Takes one frame through all stages in each call. While the caller draws it, the next one is
// prepared. Therefore changes to the show between two calls may take effect one frame later.
class LockStep {
 public:
  explicit LockStep(FrameStages stages);
  // Waits for the frame in progress. Afterwards the caller may use the stages again.
  ~LockStep();
  LockStep(const LockStep&) = delete;
  LockStep& operator=(const LockStep&) = delete;

  // Returns false at the end of the source. The end, or an error of the source, is returned by all
  // later calls too.
  Result<bool> Next(StagedFrame& staged);

 private:
  // Fills a frame and reuses its buffers.
  Result<bool> Prepare(StagedFrame& staged);

  struct Prepared {
    Result<bool> more;
    StagedFrame staged;
  };

  FrameStages stages_;
  FrameClock clock_;
  Mailbox<StagedFrame> wanted_;  // Frames to be filled.
  Mailbox<Prepared> prepared_;
  Result<bool> more_ = true;
  std::jthread thread_;
};

// Runs capture, tracking and simulation on one thread each; the caller draws. Recorded sources are
// played at their own frame rate.
class RealtimePipeline {
 public:
  explicit RealtimePipeline(FrameStages stages);
  // Stops the threads and waits for them.
  ~RealtimePipeline();
  RealtimePipeline(const RealtimePipeline&) = delete;
  RealtimePipeline& operator=(const RealtimePipeline&) = delete;

  // Returns the newest frame that is ready to be drawn, or nullptr if none came in time.
  std::unique_ptr<StagedFrame> Take(std::chrono::milliseconds timeout);
  // Returns a drawn frame, so that its buffers can be reused.
  void Recycle(std::unique_ptr<StagedFrame> staged);

  // True if the source has ended and its last frame was taken.
  bool Finished() const { return staged_.Finished(); }
  // The error with which the source ended, if any.
  Status status() const;
  // Seconds since the frame now in tracking or staging entered that stage, the longer of both; 0:
  // both are idle. Waiting for the camera does not count. From any thread.
  double LongestWork() const;

  // Stops before the source ends. Statistics are complete afterwards.
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
  // Marks a worker as busy during the object's lifetime.
  class Work;

  void Capture(const std::stop_token& stop);
  void Track(const std::stop_token& stop);
  void Simulate(const std::stop_token& stop);
  // Returns a recycled frame, or a new one.
  std::unique_ptr<StagedFrame> SpareFrame();

  FrameStages stages_;
  Mailbox<CapturedFrame> captured_;
  Mailbox<LocatedFrame> located_;
  Mailbox<std::unique_ptr<StagedFrame>> staged_;
  std::mutex spare_mutex_;
  // Frames that were drawn, or skipped for newer ones.
  std::vector<std::unique_ptr<StagedFrame>> spare_;
  mutable std::mutex status_mutex_;
  Status status_;
  // Start of each worker's current frame, in ticks of the steady clock; 0: idle.
  std::array<std::atomic<int64_t>, kWorkers> work_since_ = {};
  std::jthread capture_thread_;
  std::jthread track_thread_;
  std::jthread simulate_thread_;
};

}  // namespace lararium::show
