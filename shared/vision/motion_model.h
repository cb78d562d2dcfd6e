#pragma once

// Where a camera will be if it goes on as before.

#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::vision {

class MotionModel {
 public:
  // The pose at a time, in frames of the source.
  void Add(double time, const geometry::Rigid3& camera_from_map);
  // has_pose(). The last pose was another; the camera's motion stays as it was.
  void Correct(const geometry::Rigid3& camera_from_map);
  void Forget();

  bool has_pose() const { return last_.has_value(); }
  // has_pose().
  const geometry::Rigid3& last_pose() const { return last_->camera_from_map; }
  double last_time() const { return last_->time; }

  // The motion of the camera, now_from_before, over a number of frames at the
  // velocity of the last two poses; no motion where there is only one.
  geometry::Rigid3 Motion(double frames) const;

 private:
  struct Entry {
    double time = 0.0;
    geometry::Rigid3 camera_from_map;
  };
  std::optional<Entry> last_;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();  // each frame
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
};

}  // namespace lararium::vision
