#pragma once

// Light that reaches receivers past moving blockers: logs of visibility are added up
// ball by ball, exponentiated and multiplied with the light (Ren et al. 2006). All in
// stage axes; metres. Nothing allocates.

#include <span>

#include "shared/light/sh_product.h"
#include "shared/light/sh_rows.h"
#include "shared/light/sh_turn.h"

namespace lararium::light {

// Balls that hide light, in stage axes. All spans are equally long; a radius of 0, or
// numbers that are not finite, hide nothing.
struct Spheres {
  std::span<const float> x, y, z, radius;
};

// Points, in stage axes, moved off their surface along its normal by the caller. All
// spans are equally long.
struct Points {
  std::span<const float> x, y, z;
};

// Balls whose r^2 / (d^2 + r^2) is below this are left out; up to twice that they come
// in gradually. A ball hides about a quarter of its share of the sky, so each that is
// left out wholly or in part costs at most a quarter of this.
inline constexpr float kLeastShare = 6.25e-4f;  // an angular radius of 1.4 degrees

// Log visibility that hides nothing.
void ClearLogVisibility(ReceiverRange range, ShRows& log_visibility);

// Adds the log visibility of the spheres as seen from each point. log_visibility: 9, 16
// or 25 rows, as many receivers as points. range.begin is a multiple of kLanes.
void AddLogVisibility(const Spheres& spheres,
                      const Points& receivers,
                      ReceiverRange range,
                      ShRows& log_visibility);

// The same in a frame of each receiver's own, whose axes its turn brings to the stage's.
void AddLogVisibility(const Spheres& spheres,
                      const Points& receivers,
                      const Turns& stage_from_own,
                      ReceiverRange range,
                      ShRows& log_visibility);

// light x exp(log visibility) for each channel. All rows have light.count() rows.
// range.begin is a multiple of kLanes.
void ShadowLight(const LightMatrix& light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 ShRowsRgb& shadowed);

// visibility = exp(log visibility), clamped nowhere. As above.
void ExpRows(const ShRows& log_visibility, ReceiverRange range, ShRows& visibility);

}  // namespace lararium::light
