#pragma once

// The pose of a place's stage in the room that a device tracks by itself, such as a headset or a
// phone with WebXR. Each tracked image of the camera measures it; between these images it is kept,
// and the device tracks the viewer.

#include <limits>
#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::show {

class StageAnchor {
 public:
  // The value of `held` for devices that no further image measures.
  static constexpr double kForever = std::numeric_limits<double>::infinity();

  // held: seconds for which people are shown after the last measurement, and then fade out,
  // because the device's tracking drifts.
  explicit StageAnchor(double held = 10.0) : held_(held) {}

  // Adds a measurement (room axes, metres). Small differences are applied gradually, so that people
  // do not jitter with the errors of single images. Large differences are applied at once after
  // several measurements in a row. seconds: current time of a steady clock.
  void Observe(const geometry::Rigid3& room_from_stage, double seconds);

  // nullopt: there was no measurement yet.
  const std::optional<geometry::Rigid3>& room_from_stage() const { return room_from_stage_; }

  // Opacity of people, 0 to 1.
  float Opacity(double seconds) const;

 private:
  double held_;
  std::optional<geometry::Rigid3> room_from_stage_;
  double observed_ = 0.0;  // seconds
  int leaps_ = 0;          // number of measurements in a row with a large difference
};

}  // namespace lararium::show
