#pragma once

// The pose of a place's stage in the room that a headset's runtime tracks. Each tracked image of
// the camera measures it; between these images it is kept, and the runtime tracks the head.

#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::player {

class StageAnchor {
 public:
  // Adds a measurement (room axes, metres). Small differences are applied gradually, so that people
  // do not jitter with the errors of single images. Large differences are applied at once after
  // several measurements in a row. seconds: current time of a steady clock.
  void Observe(const geometry::Rigid3& room_from_stage, double seconds);

  // nullopt: there was no measurement yet.
  const std::optional<geometry::Rigid3>& room_from_stage() const { return room_from_stage_; }

  // Opacity of people, 0 to 1. They fade out when the last measurement is too old, because the
  // runtime's tracking drifts.
  float Opacity(double seconds) const;

 private:
  std::optional<geometry::Rigid3> room_from_stage_;
  double observed_ = 0.0;  // seconds
  int leaps_ = 0;          // number of measurements in a row with a large difference
};

}  // namespace lararium::player
