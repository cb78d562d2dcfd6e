#pragma once

// Predicts the motion of the camera at constant velocity.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shared/geometry/frame.h"
#include "shared/geometry/transform.h"

namespace lararium::vision {

// Counts time in frame times, the usual interval between the frames of a source. Phones film at a
// variable rate, and cameras drop frames, so the index of a frame does not tell when it was taken.
class FrameClock {
 public:
  // Returns the time of a frame, which is later than that of the last one unless the source was set
  // back. Where capture times do not ascend, frames count as evenly spaced.
  double Time(const geometry::Frame& frame);

 private:
  // The frame time is settled after this many intervals, because readout times are shares of it.
  static constexpr size_t kIntervals = 15;

  double Step(double seconds, double frames);

  std::array<double, kIntervals> intervals_ = {};  // Seconds.
  size_t known_ = 0;                               // The number of intervals that were seen.
  double frame_time_ = 0.0;                        // Seconds.
  std::optional<int64_t> last_index_;
  double last_capture_ = 0.0;  // Seconds.
  double now_ = 0.0;           // Frame times.
};

class MotionModel {
 public:
  // Adds the pose at a time, in frame times.
  void Add(double time, const geometry::Rigid3& camera_from_map);
  // Replaces the last pose and keeps the velocity. Requires has_pose().
  void Correct(const geometry::Rigid3& camera_from_map);
  void Forget();

  bool has_pose() const { return last_.has_value(); }
  // Requires has_pose().
  const geometry::Rigid3& last_pose() const { return last_->camera_from_map; }
  double last_time() const { return last_->time; }

  // The motion of the camera, now_from_before, over some frame times at the velocity of the last
  // two poses; the identity if there is only one.
  geometry::Rigid3 Motion(double frames) const;

 private:
  struct Entry {
    double time = 0.0;
    geometry::Rigid3 camera_from_map;
  };
  std::optional<Entry> last_;
  // Rotation vector (radians) and translation (map units) per frame time.
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
};

}  // namespace lararium::vision
