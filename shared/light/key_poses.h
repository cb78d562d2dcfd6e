#pragma once

// Which key poses a receiver's body is most like, judged by how its own balls hide the
// light from it: transfer vectors are baked at key poses, and what they do not know yet
// of the pose at hand is added as the difference of logs.

#include <span>

#include "shared/light/sh_rows.h"
#include "shared/light/transfer.h"

namespace lararium::light {

// A squared distance between logs (summed over coefficients) that nobody sees: poses that
// are less apart at a receiver are told apart by prior only.
inline constexpr float kIndistinct = 1e-3f;

// keys[pose] and now: log visibility of the person's own balls at its receivers, at each
// key pose and now, all in the frame of the receiver's bone (sh_turn.h). At most
// kMaxKeyPoses keys.
//
// weights: [receiver][kMaxKeyPoses], positive, sum 1; of poses that do not exist 0.
// Inverse distances to the fourth power (Shepard, "A two-dimensional interpolation
// function for irregularly-spaced data", 1968) times prior; what is then below
// kLeastPoseWeight fades to exactly 0. At a key pose that differs from the others the
// weight is exactly 1. Continuous in now.
//
// prior: one for each key, >= 0 and not all 0, for example from the skeleton's distance;
// empty: all alike. It decides alone where the pose changes nothing.
// range.begin is a multiple of kLanes. Allocates nothing.
void KeyPoseWeights(std::span<const ShRows> keys,
                    const ShRows& now,
                    std::span<const float> prior,
                    ReceiverRange range,
                    std::span<float> weights);

// delta = now - sum_k weight_k keys_k: the log visibility that blended transfer does not
// hold already. 0 at a key pose. delta may be now.
void SubtractKeyPoses(std::span<const ShRows> keys,
                      const ShRows& now,
                      std::span<const float> weights,
                      ReceiverRange range,
                      ShRows& delta);

}  // namespace lararium::light
