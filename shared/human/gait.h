#pragma once

// How people walk on level ground: angles over a stride, and stride against speed. Lengths are
// shares of the leg's length (hip joint to floor) unless stated otherwise.

#include "shared/human/locomotion.h"

namespace lararium::human {

// Angles over a stride, radians. The phase may have any value; it is a whole number when the heel
// of this leg strikes. The functions are truncated Fourier series of curves drawn through the
// landmarks (peaks and zero crossings by phase) of Perry & Burnfield (2010) and Winter (2009); they
// are not the tabulated means of either source.
float ThighInclination(float phase);  // against the vertical, forward positive
float KneeFlexion(float phase);
float AnkleFlexion(float phase);  // dorsiflexion positive
// Pitch of the sole against the floor, from the three angles above; positive raises the toes.
float SolePitch(float phase);

// The stride for a given speed.
struct Stride {
  float per_second = 0.0f;    // strides (of two steps) per second
  float stance_share = 0.0f;  // Share of the stride in which a foot is on the floor.
  float ahead_share = 0.0f;   // Share of the stance that passes before the foot is below its hip.
  float amount = 0.0f;        // Factor on the angles above: 1 at a comfortable speed.
};
// speed in m/s, leg_length in metres, turn_rate in rad/s. forwardness: 1 walks forward; 0 walks
// sideways or backwards, in shorter and flatter steps. Turning on the spot needs steps too.
Stride StrideAt(
    float speed, float forwardness, float turn_rate, float leg_length, const GaitStyle& style);

// Pitch of the sole during the stance (0..1) at amount 1. The middle of the stance is exactly flat.
float StancePitch(float stance);

// Motion of a foot during the swing (0..1) at amount 1.
struct SwingPoint {
  float progress = 0.0f;  // Progress of the ankle from lift-off to landing, 0..1.
  float height = 0.0f;    // Height of the ankle above the straight line of its path.
  float pitch = 0.0f;     // 0: sole as at lift-off; 1: sole as at landing.
};
SwingPoint SwingAt(float swing);

}  // namespace lararium::human
