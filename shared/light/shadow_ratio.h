#pragma once

// How much of its light a real surface loses to what stands before it: the ratio by
// which differential rendering darkens the camera's image (Debevec, "Rendering Synthetic
// Objects into Real Scenes", SIGGRAPH 1998), for each channel, since light that comes
// from elsewhere has another colour.

#include <glm/vec3.hpp>
#include <span>

#include "shared/light/sh_rows.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::light {

// M, the projection of light(d) max(0, normal . d): what falls on a surface with this
// unit normal, direction by direction. Exact for all bands that it holds.
ShRgb CosineLight(const ShRgb& light, const glm::vec3& normal);

struct RgbSpans {
  std::span<float> r, g, b;
};

// ratio = dot(exp(log visibility), M) / dot(1, M), between 0 and 1; 1 where no light
// falls. All receivers share one normal; the first coefficients of M are used, as many
// as log_visibility has. ratio: [receiver]. range.begin is a multiple of kLanes.
// Allocates nothing.
void ShadowRatio(const ShRgb& cosine_light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 const RgbSpans& ratio);

// The same with M for each receiver: rows as log_visibility has them.
void ShadowRatio(const ShRowsRgb& cosine_light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 const RgbSpans& ratio);

}  // namespace lararium::light
