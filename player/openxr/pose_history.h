#pragma once

// Stores recent poses of the head, because an image of the camera is older than the current pose.

#include <cstdint>
#include <deque>
#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::player {

class PoseHistory {
 public:
  static constexpr int64_t kLongest = 3'000'000'000;  // nanoseconds; older poses are removed

  // Poses whose time does not increase are ignored.
  void Add(int64_t time_ns, const geometry::Rigid3& pose);

  // The pose at a time, interpolated between stored poses; outside their range the first or the
  // last. nullopt: there are no poses.
  std::optional<geometry::Rigid3> At(int64_t time_ns) const;

 private:
  struct Entry {
    int64_t time_ns;
    geometry::Rigid3 pose;
  };
  std::deque<Entry> entries_;
};

}  // namespace lararium::player
