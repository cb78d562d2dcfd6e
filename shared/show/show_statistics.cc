#include "shared/show/show_statistics.h"

#include <sys/resource.h>

namespace lararium::show {
namespace {

double Ratio(int64_t part, int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

void TrackingStatistics::Add(const vision::TrackedFrame& frame) {
  const bool tracking = frame.camera_from_map.has_value();
  ++frames_;
  tracked_ += tracking ? 1 : 0;
  inliers_ += tracking ? frame.inliers : 0;
  relocalizations_ += tracking && had_pose_ && !was_tracking_ ? 1 : 0;
  had_pose_ = had_pose_ || tracking;
  was_tracking_ = tracking;
}

double TrackingStatistics::tracked_fraction() const { return Ratio(tracked_, frames_); }

double TrackingStatistics::mean_inliers() const { return Ratio(inliers_, tracked_); }

double PeakResidentMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Json ShowStatistics::ToJson() const {
  return {{"capture", capture.ToJson()},
          {"track", track.ToJson()},
          {"simulate", simulate.ToJson()},
          {"render", render.ToJson()},
          {"total", total.ToJson()},
          {"frames", tracking.frames()},
          {"tracked_fraction", tracking.tracked_fraction()},
          {"relocalizations", tracking.relocalizations()},
          {"inliers", tracking.mean_inliers()},
          {"peak_resident_mib", PeakResidentMebibytes()},
          {"startup_seconds", startup_seconds},
          {"dropped_frames", dropped_frames},
          {"gpu", gpu}};
}

}  // namespace lararium::show
