#pragma once

// What stats.json reports of a run.

#include <cstdint>
#include <string>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/statistics.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// How tracking went, frame by frame.
class TrackingStatistics {
 public:
  void Add(const vision::TrackedFrame& frame);

  int64_t frames() const { return frames_; }
  double tracked_fraction() const;   // of all frames
  double followed_fraction() const;  // of all frames: pose from the frame before
  // Poses that followed a frame without one, the first pose not counted.
  int64_t relocalizations() const { return relocalizations_; }
  double mean_inliers() const;     // of tracked frames
  double mean_confidence() const;  // of tracked frames
  // Tracked frames in each map, as far as the last map with any.
  const std::vector<int64_t>& frames_in_map() const { return frames_in_map_; }

 private:
  int64_t frames_ = 0;
  int64_t tracked_ = 0;
  int64_t followed_ = 0;
  int64_t relocalizations_ = 0;
  int64_t inliers_ = 0;
  double confidence_ = 0.0;  // sum
  std::vector<int64_t> frames_in_map_;
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
  DurationHistogram total;  // from an image's arrival until it is composited
  // How old an image is when it is located, staged, drawn and handed to the display.
  DurationHistogram located_age;
  DurationHistogram staged_age;
  DurationHistogram drawn_age;
  DurationHistogram shown_age;
  DurationHistogram interval;     // between pictures
  Json quality = Json::object();  // QualityController::ToJson
  TrackingStatistics tracking;
  std::vector<std::string> places;  // names, in the order of the tracker's maps
  uint64_t dropped_frames = 0;
  double startup_seconds = 0.0;  // from the start of the program to the first composite
  std::string gpu;
  std::string graphics;  // what it is drawn with

  Json ToJson() const;
};

// The most memory that this process has had resident, in MiB.
double PeakResidentMebibytes();
// And what it has now; 0 where that is not known.
double ResidentMebibytes();

}  // namespace lararium::show
