#pragma once

// How people walk on the level: angles over a stride, and stride against speed.
// Lengths are shares of the leg's length (hip joint to floor) unless said otherwise.

#include <array>

#include "shared/human/locomotion.h"

namespace lararium::human {

// Angles over a stride, radians, at a phase of any value: whole when the heel of this
// leg strikes. Truncated Fourier series of curves drawn through the landmarks of
// Perry & Burnfield (2010) and Winter (2009): peaks and zero crossings by phase; they
// are not the tabulated means of either.
float ThighInclination(float phase);  // forwards, against the vertical
float KneeFlexion(float phase);
float AnkleFlexion(float phase);  // dorsal
// Of the sole against the floor, toes up, by the three above.
float SolePitch(float phase);

// The stride that belongs to a speed.
struct Stride {
  float per_second = 0.0f;    // strides, of two steps
  float stance_share = 0.0f;  // of the stride in which a foot is on the floor
  float ahead_share = 0.0f;   // of the stance that passes before the foot is below its hip
  float amount = 0.0f;        // of the angles above: 1 at a comfortable speed
};
// speed in m/s, leg_length in metres. forwardness: 1 walks forward, 0 sidles or backs, in
// shorter and flatter steps. turn_rate in rad/s makes for steps too.
Stride StrideAt(
    float speed, float forwardness, float turn_rate, float leg_length, const GaitStyle& style);

// The sole's pitch while the foot stands, at 0..1 of the stance, at amount 1. Exactly
// flat in between.
float StancePitch(float stance);

// How a foot swings at amount 1, at 0..1 of the swing.
struct SwingPoint {
  float progress = 0.0f;  // of the ankle from where it left to where it lands, 0..1
  float height = 0.0f;    // of the ankle over the straight way
  float pitch = 0.0f;     // 0 the sole as it left, 1 as it lands
};
SwingPoint SwingAt(float swing);

}  // namespace lararium::human
