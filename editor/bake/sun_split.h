#pragma once

// Finds the sun in the image of a probe and removes it, so that spherical harmonics represent
// the rest without ringing and the sun casts sharp shadows.

#include <optional>

#include "editor/bake/probe.h"
#include "shared/light/probe_light.h"

namespace lararium::bake {

// A compact source is a sun if it gives at least this share of the irradiance of a surface that
// faces it. For a weaker source, a blurred shadow loses less than this share of the light.
inline constexpr double kLeastSunShare = 0.08;

struct SplitProbe {
  ProbeImage sky;  // The image with the sun replaced by the radiance around it.
  // In the axes of the probe and the units of the file.
  std::optional<light::Sun> sun;
  // The brightest source, whether it is a sun or not.
  light::Sun brightest;
  double share = 0.0;  // Share of the irradiance (luminance) of a surface that faces `brightest`.
};

// Finds the brightest texel (of the image resampled to 512 columns, so that a single hot pixel
// does not win), refines its centre, and takes the smallest cap about it that contains what
// exceeds the surrounding radiance within kMaxSunRadius. A source that fills a larger cap
// evenly, like a window, exceeds its surroundings little and stays in the sky.
SplitProbe SplitSun(const ProbeImage& image);

// The light of a probe in stage axes, with its sun separate.
light::ProbeLight ProjectProbeLight(const ProbeImage& image, const ProbePlacement& placement);

}  // namespace lararium::bake
