#pragma once

// A declarative track: position, heading and clip of an actor as a pure function of the drama's
// time.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/drama/timeline_lanes.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// A segment lasts until the next one begins. During `length` the actor moves in a straight line
// from `from` to `to`, eased by `ease`, and then stays.
struct TrackSegment {
  double begin = 0.0;   // Time of the drama, seconds.
  double length = 0.0;  // Seconds.
  int clip = human::Animation::kNoClip;
  double rate = 1.0;  // Playback rate of the clip.
  double fade = 0.0;  // Crossfade from the segment before, seconds.
  glm::vec3 from = glm::vec3(0.0f);
  glm::vec3 to = glm::vec3(0.0f);
  float heading = 0.0f;  // Radians.
  Ease ease = Ease::kLinear;
};

struct Track {
  stage::ActorId actor;
  std::vector<TrackSegment> segments;  // Sorted by `begin`.
};

// Sets position, heading, clip and visibility of the actor at a time; before the first segment it
// is hidden. Does not change anything else.
void ApplyTrack(std::span<const TrackSegment> segments, double time, stage::ActorState& state);

}  // namespace lararium::drama
