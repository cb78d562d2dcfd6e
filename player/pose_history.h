#pragma once

// Where the head was a moment ago: an image of the camera is older than what is shown.

#include <cstdint>
#include <deque>
#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::player {

class PoseHistory {
 public:
  static constexpr int64_t kLongest = 3'000'000'000;  // nanoseconds that are remembered

  // Times that do not go on are left out.
  void Add(int64_t time_ns, const geometry::Rigid3& pose);

  // The pose at a time, between those that are known; the first or last one outside. None where
  // none is known.
  std::optional<geometry::Rigid3> At(int64_t time_ns) const;

 private:
  struct Entry {
    int64_t time_ns;
    geometry::Rigid3 pose;
  };
  std::deque<Entry> entries_;
};

}  // namespace lararium::player
