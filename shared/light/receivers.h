#pragma once

// Light that reaches receivers past moving blockers: logs of visibility are summed over the balls,
// exponentiated and multiplied with the light (Ren et al. 2006). Stage axes, metres. Allocates
// nothing.

#include <span>

#include "shared/light/sh_product.h"
#include "shared/light/sh_rows.h"
#include "shared/light/sh_turn.h"

namespace lararium::light {

// Balls that block light, in stage axes. All spans have equal lengths. A ball with radius 0 or with
// numbers that are not finite blocks nothing.
struct Spheres {
  std::span<const float> x, y, z, radius;
};

// Receiver points in stage axes. The caller moves them off their surface along its normal. All
// spans have equal lengths.
struct Points {
  std::span<const float> x, y, z;
};

// Balls whose r^2 / (d^2 + r^2) is below this are left out; up to twice this value they fade in. A
// ball hides about a quarter of its share of the sky, so leaving it out costs at most a quarter of
// this value.
inline constexpr float kLeastShare = 6.25e-4f;  // an angular radius of 1.4 degrees

// Sets the log visibility to that without blockers.
void ClearLogVisibility(ReceiverRange range, ShRows& log_visibility);

// Adds the log visibility past the spheres at each point. log_visibility has 9, 16 or 25 rows and
// as many receivers as there are points. range.begin is a multiple of kLanes.
void AddLogVisibility(const Spheres& spheres,
                      const Points& receivers,
                      ReceiverRange range,
                      ShRows& log_visibility);

// Same as above in each receiver's own frame, whose axes stage_from_own rotates into the stage's.
void AddLogVisibility(const Spheres& spheres,
                      const Points& receivers,
                      const Turns& stage_from_own,
                      ReceiverRange range,
                      ShRows& log_visibility);

// light x exp(log visibility) for each channel. All arrays have light.count() rows. range.begin is
// a multiple of kLanes.
void ShadowLight(const LightMatrix& light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 ShRowsRgb& shadowed);

}  // namespace lararium::light
