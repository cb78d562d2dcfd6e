#pragma once

// Where a place's stage is in the room that a headset's runtime tracks: each image of the camera
// that was tracked says it anew, and between and without them the runtime's tracking holds it.

#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::player {

class StageAnchor {
 public:
  // Room axes, metres. What differs little is taken over little by little, so that people do not
  // tremble with the errors of single images; what differs much at once, after it was seen so a few
  // times in a row. seconds: by a steady clock, when it is told.
  void Observe(const geometry::Rigid3& room_from_stage, double seconds);

  // None before the first observation.
  const std::optional<geometry::Rigid3>& room_from_stage() const { return room_from_stage_; }

  // How far people are to be seen, 0 to 1: as long as it is not too long ago that the camera knew
  // where it was, since the runtime's tracking drifts.
  float Opacity(double seconds) const;

 private:
  std::optional<geometry::Rigid3> room_from_stage_;
  double observed_ = 0.0;  // seconds
  int leaps_ = 0;          // observations in a row that differ much
};

}  // namespace lararium::player
