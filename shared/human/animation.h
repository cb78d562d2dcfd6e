#pragma once

// Which clip a person plays, as plain values.

#include "shared/human/blend.h"

namespace lararium::human {

// The playing clip and its time. Times continue past the end of a clip, so that they can be
// interpolated; sampling handles the loop.
struct Animation {
  static constexpr int kNoClip = -1;

  int clip = kNoClip;      // Index into Human::clips; kNoClip: gait, seat and reach pose the body.
  double clip_time = 0.0;  // seconds into the clip
  double rate = 1.0;       // speed factor
  BodyPart part = BodyPart::kWhole;  // The part of the body that the clip moves.
  int previous_clip = kNoClip;       // Fades out while weight is below 1.
  double previous_time = 0.0;
  double previous_rate = 1.0;
  BodyPart previous_part = BodyPart::kWhole;
  float weight = 1.0f;             // Weight of clip against previous_clip, 0..1.
  float weight_per_second = 0.0f;  // Rate at which weight grows.

  friend bool operator==(const Animation&, const Animation&) = default;
};

// Fades from the current clip to `clip` (kNoClip: to no clip), which starts at its beginning, over
// fade_seconds. A fade that is still running is cut short.
void StartClip(Animation& animation,
               int clip,
               double rate,
               float fade_seconds,
               BodyPart part = BodyPart::kWhole);

void UpdateAnimation(Animation& animation, double seconds);

// Interpolates between two neighbouring ticks, alpha 0..1. Returns current where it plays another
// clip.
Animation Interpolate(const Animation& previous, const Animation& current, float alpha);

}  // namespace lararium::human
