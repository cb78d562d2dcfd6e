#pragma once

// Predicts the motion of the camera at constant velocity.

#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::vision {

class MotionModel {
 public:
  // Adds the pose at a time; the unit of time is one frame of the source.
  void Add(double time, const geometry::Rigid3& camera_from_map);
  // Replaces the last pose and keeps the velocity. Requires has_pose().
  void Correct(const geometry::Rigid3& camera_from_map);
  void Forget();

  bool has_pose() const { return last_.has_value(); }
  // Requires has_pose().
  const geometry::Rigid3& last_pose() const { return last_->camera_from_map; }
  double last_time() const { return last_->time; }

  // The motion of the camera, now_from_before, over a number of frames at the velocity of the last
  // two poses; the identity if there is only one.
  geometry::Rigid3 Motion(double frames) const;

 private:
  struct Entry {
    double time = 0.0;
    geometry::Rigid3 camera_from_map;
  };
  std::optional<Entry> last_;
  // Rotation vector (radians) and translation (map units) per frame.
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
};

}  // namespace lararium::vision
