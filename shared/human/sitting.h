#pragma once

// Sitting down, sitting, and standing up, for bodies of any proportions. The feet stay in place; a
// person who is too small for a seat lets them hang. Standing up has the phases of Schenkman et al.
// (Phys. Ther. 70, 1990): the trunk swings forward over the feet, the body leaves the seat and
// keeps that momentum, hips and knees extend, and all comes to rest. The order is from the paper;
// when each phase begins and how far it goes is set by eye. Sitting down is the same motion
// backwards.

#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body_rig.h"
#include "shared/human/reach.h"

namespace lararium::human {

struct Human;

// The complete state of sitting, as plain values. The root of a seated person does not move.
struct Sitting {
  // Point on the seat's surface below the midpoint of the hip joints; metres, actor frame.
  glm::vec3 seat = glm::vec3(0.0f);
  float amount = 0.0f;   // Progress in time: 0 stands, 1 sits.
  bool down = false;     // True while sitting down or seated.
  float seconds = 1.8f;  // Duration of the whole motion.

  friend bool operator==(const Sitting&, const Sitting&) = default;
};

// A natural duration in seconds of either motion for a body of this size; people with a lower
// cadence take longer.
float SittingSeconds(const BodyRig& body, float cadence);
void SitDown(Sitting& sitting, const glm::vec3& actor_from_seat, float seconds);
void StandUp(Sitting& sitting, float seconds);
void UpdateSitting(Sitting& sitting, float seconds);
Sitting Interpolate(const Sitting& previous, const Sitting& current, float alpha);

// Constants of one body for sitting; build once.
struct SittingModel {
  BodyRig body;
  float seat_to_hips = 0.0f;  // Metres from the seat's surface up to the hip joints.
  float thigh_radius = 0.0f;  // Metres from the thigh's axis to where a hand lies on it.
};
SittingModel MakeSittingModel(const Human& human, const BodyRig& body);

// Distance in metres from the seat's point at which the root must stand to sit down. seat_height is
// above the floor; front is the distance from the seat's point to its front edge.
float StandBeforeSeat(const SittingModel& model, float seat_height, float front);

// Metres by which a person with short thighs sits nearer to the front edge, so that the knees bend
// over it.
float ForwardOnSeat(const SittingModel& model, float front);

// Displacement of the hips, and of everything above them, from the standing pose; metres, actor
// frame.
glm::vec3 HipsShift(const SittingModel& model, const Sitting& sitting);

// Share of the body's weight on the seat: 0 stands, 1 sits.
float SeatedShare(const Sitting& sitting);

// Turns a standing pose into a seated one, or into one of the motion between the two.
void ApplySitting(const SittingModel& model,
                  const ReachModel& reach,
                  const Skeleton& skeleton,
                  const Sitting& sitting,
                  std::span<JointTransform> pose);

}  // namespace lararium::human
