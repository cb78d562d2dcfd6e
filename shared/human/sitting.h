#pragma once

// Sitting down, sitting, and standing up again, for any proportions. Feet stay where
// they stand; who is too small for a seat lets them hang. Standing up has the phases of
// Schenkman et al. (Phys. Ther. 70, 1990): the trunk swings forward over the feet, the
// body leaves the seat and carries that momentum on, hips and knees extend, all comes to
// rest. Their order is theirs; when each begins and how far it goes is set by eye.
// Sitting down is the same backwards.

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body.h"
#include "shared/human/reach.h"

namespace lararium::human {

struct Human;

// All that sitting remembers; plain values. Who sits does not move its root.
struct Sitting {
  // On what one sits on, below the middle between the hip joints; metres, actor frame.
  glm::vec3 seat = glm::vec3(0.0f);
  float amount = 0.0f;   // of the motion's time: 0 stands, 1 sits
  bool down = false;     // where it goes to
  float seconds = 1.8f;  // from one to the other

  friend bool operator==(const Sitting&, const Sitting&) = default;
};

// A natural duration of either motion: of people of this size, slower for those who
// step slower; seconds.
float SittingSeconds(const Body& body, float cadence);
void SitDown(Sitting& sitting, const glm::vec3& actor_from_seat, float seconds);
void StandUp(Sitting& sitting, float seconds);
void UpdateSitting(Sitting& sitting, float seconds);
Sitting Interpolate(const Sitting& previous, const Sitting& current, float alpha);

// What sitting knows of one body; build once.
struct SittingModel {
  Body body;
  float seat_to_hips = 0.0f;  // metres from what one sits on up to the hip joints
  float thigh_radius = 0.0f;  // metres, where hands lie on it
};
SittingModel MakeSittingModel(const Human& human, const Body& body);

// How far before the seat's point the root has to stand to sit down, metres.
// seat_height: above the floor. front: from the seat's point to its front edge.
float StandBeforeSeat(const SittingModel& model, float seat_height, float front);

// Who has short thighs sits nearer to the front edge, so that knees bend over it: by how
// much, metres.
float ForwardOnSeat(const SittingModel& model, float front);

// By how much hips, and all above, are moved from where they are upright; metres, actor
// frame.
glm::vec3 HipsShift(const SittingModel& model, const Sitting& sitting);

// How much of the body the seat bears: 0 stands, 1 sits.
float SeatedShare(const Sitting& sitting);

// Turns a standing pose into one that sits, or is on the way.
void ApplySitting(const SittingModel& model,
                  const ReachModel& reach,
                  const Skeleton& skeleton,
                  const Sitting& sitting,
                  std::span<JointTransform> pose);

}  // namespace lararium::human
