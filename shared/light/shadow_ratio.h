#pragma once

// Share of its light that a real surface keeps behind virtual blockers: the ratio by which
// differential rendering darkens the camera's image (Debevec, "Rendering Synthetic Objects into
// Real Scenes", SIGGRAPH 1998). It is computed for each channel, because light from different
// directions differs in colour.

#include <glm/vec3.hpp>
#include <span>

#include "shared/light/sh_rows.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::light {

// M, the projection of light(d) max(0, normal . d): the light on a surface with this unit normal by
// direction. Exact for all bands that it holds.
ShRgb CosineLight(const ShRgb& light, const glm::vec3& normal);

struct RgbSpans {
  std::span<float> r, g, b;
};

// ratio = dot(exp(log visibility), M) / dot(1, M), between 0 and 1; 1 if there is no light. All
// receivers share one normal. The first coefficients of M are used, as many as log_visibility has.
// ratio: [receiver]. range.begin is a multiple of kLanes. Allocates nothing.
void ShadowRatio(const ShRgb& cosine_light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 const RgbSpans& ratio);

// Same as above with a separate M for each receiver, in as many rows as log_visibility has.
void ShadowRatio(const ShRowsRgb& cosine_light,
                 const ShRows& log_visibility,
                 ReceiverRange range,
                 const RgbSpans& ratio);

}  // namespace lararium::light
