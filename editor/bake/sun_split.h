#pragma once

// Finds the sun of a probe's image and takes it out, so that harmonics hold the rest
// without ringing and the sun casts shadows with edges.

#include <optional>

#include "editor/bake/probe.h"
#include "shared/light/probe_light.h"

namespace lararium::bake {

// The share of a facing surface's irradiance from which on a compact source is a sun: what a
// blurred shadow would miss of a weaker one is less than such a share of the light.
inline constexpr double kLeastSunShare = 0.08;

struct SplitProbe {
  ProbeImage sky;  // the image, the sun replaced by the radiance around it
  // In the probe's axes, for the file's units.
  std::optional<light::Sun> sun;
  // What was found at the brightest place, a sun or not.
  light::Sun brightest;
  double share = 0.0;  // of the irradiance of a surface facing it, by luminance
};

// The brightest texel (of the image brought to 512 columns, so that one hot pixel does not
// win), centred, and the smallest cap about it that holds what lies within
// kMaxSunRadius above the radiance around that. A source that fills a larger cap evenly, like
// a window, has little above what is around it and stays in the sky.
SplitProbe SplitSun(const ProbeImage& image);

// The light of a probe in stage axes, its sun apart.
light::ProbeLight ProjectProbeLight(const ProbeImage& image, const ProbePlacement& placement);

}  // namespace lararium::bake
