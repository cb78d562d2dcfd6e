#pragma once

// What stats.json reports of a run.

#include <cstdint>
#include <string>

#include "shared/core/json.h"
#include "shared/core/statistics.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// How tracking went, frame by frame.
class TrackingStatistics {
 public:
  void Add(const vision::TrackedFrame& frame);

  int64_t frames() const { return frames_; }
  double tracked_fraction() const;
  // Poses that followed a frame without one, the first pose not counted.
  int64_t relocalizations() const { return relocalizations_; }
  double mean_inliers() const;  // of tracked frames

 private:
  int64_t frames_ = 0;
  int64_t tracked_ = 0;
  int64_t relocalizations_ = 0;
  int64_t inliers_ = 0;
  bool had_pose_ = false;
  bool was_tracking_ = false;
};

// Each StageTimes is written by the one thread that runs the stage; read them
// when the threads have ended.
struct ShowStatistics {
  StageTimes capture;
  StageTimes track;
  StageTimes simulate;
  StageTimes render;
  StageTimes total;  // from an image's arrival until it is composited
  TrackingStatistics tracking;
  uint64_t dropped_frames = 0;
  double startup_seconds = 0.0;  // from the start of the program to the first composite
  std::string gpu;

  Json ToJson() const;
};

// The most memory that this process has had resident, in MiB.
double PeakResidentMebibytes();

}  // namespace lararium::show
