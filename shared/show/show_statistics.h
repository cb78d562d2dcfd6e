#pragma once

// The statistics of a run in stats.json.

#include <cstdint>
#include <string>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/statistics.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// Counts tracking results frame by frame.
class TrackingStatistics {
 public:
  void Add(const vision::TrackedFrame& frame);

  int64_t frames() const { return frames_; }
  double tracked_fraction() const;  // Share of frames with a pose.
  // Share of frames whose pose was tracked from the previous frame.
  double followed_fraction() const;
  // Number of poses after a frame without one, not counting the first pose.
  int64_t relocalizations() const { return relocalizations_; }
  double mean_inliers() const;     // Mean over frames with a pose.
  double mean_confidence() const;  // Mean over frames with a pose.
  // Tracked frames in each map, up to the last map that has any.
  const std::vector<int64_t>& frames_in_map() const { return frames_in_map_; }

 private:
  int64_t frames_ = 0;
  int64_t tracked_ = 0;
  int64_t followed_ = 0;
  int64_t relocalizations_ = 0;
  int64_t inliers_ = 0;
  double confidence_ = 0.0;  // Sum over frames with a pose.
  std::vector<int64_t> frames_in_map_;
  bool had_pose_ = false;
  bool was_tracking_ = false;
};

// Each StageTimes is written by the one thread that runs the stage. Read them only after the
// threads have ended.
struct ShowStatistics {
  StageTimes capture;
  StageTimes track;
  StageTimes simulate;
  StageTimes render;
  DurationHistogram total;  // Time between an image's arrival and its composite.
  // Age of an image when it is located, staged, drawn, and handed to the display.
  DurationHistogram located_age;
  DurationHistogram staged_age;
  DurationHistogram drawn_age;
  DurationHistogram shown_age;
  DurationHistogram interval;     // Time between pictures.
  Json quality = Json::object();  // QualityController::ToJson
  TrackingStatistics tracking;
  std::vector<std::string> places;  // Names, in the order of the tracker's maps.
  uint64_t dropped_frames = 0;
  double startup_seconds = 0.0;  // Time between the start of the program and the first composite.
  std::string gpu;
  std::string graphics;  // Graphics API in use.

  Json ToJson() const;
};

// Peak resident memory of this process, in MiB.
double PeakResidentMebibytes();
// Present resident memory in MiB; 0 if unknown.
double ResidentMebibytes();

}  // namespace lararium::show
