#include "shared/show/show_statistics.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>

namespace lararium::show {
namespace {

double Ratio(double part, int64_t whole) {
  return whole == 0 ? 0.0 : part / static_cast<double>(whole);
}

}  // namespace

void TrackingStatistics::Add(const vision::TrackedFrame& frame) {
  const bool tracking = frame.camera_from_map.has_value();
  ++frames_;
  if (tracking) {
    ++tracked_;
    followed_ += frame.followed ? 1 : 0;
    inliers_ += frame.inliers;
    confidence_ += frame.confidence;
    if (frame.map >= frames_in_map_.size()) {
      frames_in_map_.resize(frame.map + 1);
    }
    ++frames_in_map_[frame.map];
  }
  relocalizations_ += tracking && had_pose_ && !was_tracking_ ? 1 : 0;
  had_pose_ = had_pose_ || tracking;
  was_tracking_ = tracking;
}

double TrackingStatistics::tracked_fraction() const {
  return Ratio(static_cast<double>(tracked_), frames_);
}

double TrackingStatistics::followed_fraction() const {
  return Ratio(static_cast<double>(followed_), frames_);
}

double TrackingStatistics::mean_inliers() const {
  return Ratio(static_cast<double>(inliers_), tracked_);
}

double TrackingStatistics::mean_confidence() const { return Ratio(confidence_, tracked_); }

double PeakResidentMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double ResidentMebibytes() {
  long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%*s %ld", &pages) != 1) {
      pages = 0;
    }
    std::fclose(file);
  }
  return static_cast<double>(pages) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

Json ShowStatistics::ToJson() const {
  const std::vector<int64_t>& counts = tracking.frames_in_map();
  Json frames_in_place = Json::object();
  for (size_t i = 0; i < places.size(); ++i) {
    frames_in_place[places[i]] = i < counts.size() ? counts[i] : 0;
  }
  return {{"capture", capture.ToJson()},
          {"track", track.ToJson()},
          {"simulate", simulate.ToJson()},
          {"render", render.ToJson()},
          {"total", total.ToJson()},
          {"age",
           {{"located", located_age.ToJson()},
            {"staged", staged_age.ToJson()},
            {"drawn", drawn_age.ToJson()},
            {"shown", shown_age.ToJson()}}},
          {"interval", interval.ToJson()},
          {"frames_per_second", interval.count() == 0 ? 0.0 : 1000.0 / interval.mean()},
          {"quality", quality},
          {"frames", tracking.frames()},
          {"tracked_fraction", tracking.tracked_fraction()},
          {"followed_fraction", tracking.followed_fraction()},
          {"relocalizations", tracking.relocalizations()},
          {"inliers", tracking.mean_inliers()},
          {"confidence", tracking.mean_confidence()},
          {"frames_in_place", frames_in_place},
          {"peak_resident_mib", PeakResidentMebibytes()},
          {"resident_mib", ResidentMebibytes()},
          {"startup_seconds", startup_seconds},
          {"dropped_frames", dropped_frames},
          {"gpu", gpu},
          {"graphics", graphics}};
}

}  // namespace lararium::show
