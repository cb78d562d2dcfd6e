#pragma once

// Weights of the key poses at each receiver, judged by how the body's own blockers hide the light
// there. Transfer vectors are baked at key poses; the difference of logs adds what they lack for
// the current pose.

#include <span>

#include "shared/light/sh_rows.h"
#include "shared/light/transfer.h"

namespace lararium::light {

// Squared distance between logs, summed over coefficients, that is invisible. Poses that differ by
// less at a receiver are distinguished by `prior` alone.
inline constexpr float kIndistinct = 1e-3f;

// keys[pose] and now: log visibility of the person's own blockers at its receivers, at each key
// pose and in the current pose, in the frame of the receiver's bone (sh_turn.h). At most
// kMaxKeyPoses keys.
//
// weights: [receiver][kMaxKeyPoses], positive with the sum 1; 0 for poses that do not exist. They
// are inverse distances to the fourth power (Shepard, "A two-dimensional interpolation function for
// irregularly-spaced data", 1968) times prior; weights below kLeastPoseWeight fade to exactly 0. At
// a key pose that differs from the others its weight is exactly 1. The weights are continuous in
// `now`.
//
// prior: one value for each key, >= 0 and not all 0, for example from the skeleton's distance.
// Empty: equal values. The prior alone decides where the pose makes no difference. range.begin is a
// multiple of kLanes. Allocates nothing.
void KeyPoseWeights(std::span<const ShRows> keys,
                    const ShRows& now,
                    std::span<const float> prior,
                    ReceiverRange range,
                    std::span<float> weights);

// delta = now - sum_k weight_k keys_k: the log visibility that the blended transfer does not
// include. It is 0 at a key pose. `delta` may be the same object as `now`.
void SubtractKeyPoses(std::span<const ShRows> keys,
                      const ShRows& now,
                      std::span<const float> weights,
                      ReceiverRange range,
                      ShRows& delta);

}  // namespace lararium::light
