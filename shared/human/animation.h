#pragma once

// Which clip a person plays, as plain values.

#include "shared/human/blend.h"

namespace lararium::human {

// Which clip plays and how far it has come. Times count on past the end of a
// clip: looping is the sampler's business, so that times interpolate.
struct Animation {
  static constexpr int kNoClip = -1;

  int clip = kNoClip;                // index into Human::clips; none: the body moves by itself
  double clip_time = 0.0;            // seconds into the clip
  double rate = 1.0;                 // how fast it plays
  BodyPart part = BodyPart::kWhole;  // what the clip moves
  int previous_clip = kNoClip;       // fades out while weight < 1
  double previous_time = 0.0;
  double previous_rate = 1.0;
  BodyPart previous_part = BodyPart::kWhole;
  float weight = 1.0f;             // of clip against previous_clip, 0..1
  float weight_per_second = 0.0f;  // how fast weight grows

  friend bool operator==(const Animation&, const Animation&) = default;
};

// Fades from what plays to clip (kNoClip: to no clip), from its beginning, over
// fade_seconds. A fade that was still going on is cut short.
void StartClip(Animation& animation,
               int clip,
               double rate,
               float fade_seconds,
               BodyPart part = BodyPart::kWhole);

void UpdateAnimation(Animation& animation, double seconds);

// Between two neighbouring ticks, alpha 0..1; current where it plays something else.
Animation Interpolate(const Animation& previous, const Animation& current, float alpha);

}  // namespace lararium::human
