#pragma once

// A declarative track: what an actor does over the drama's time, as a pure
// function of that time.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/drama/timeline_lanes.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// From begin on until the next segment begins. Over length the actor moves from
// one point to the other in a straight line, as its ease says, and then stays.
struct TrackSegment {
  double begin = 0.0;   // seconds of the drama
  double length = 0.0;  // seconds
  int clip = human::Animation::kNoClip;
  double rate = 1.0;  // of the clip
  double fade = 0.0;  // seconds, from the segment before
  glm::vec3 from = glm::vec3(0.0f);
  glm::vec3 to = glm::vec3(0.0f);
  float heading = 0.0f;       // radians
  Ease ease = Ease::kLinear;  // of the way from one point to the other
};

struct Track {
  stage::ActorId actor;
  std::vector<TrackSegment> segments;  // begin increases
};

// Sets where the actor is, which clip it plays, and that it is seen: before the first
// segment it is hidden. What its body does besides is left alone.
void ApplyTrack(std::span<const TrackSegment> segments, double time, stage::ActorState& state);

}  // namespace lararium::drama
