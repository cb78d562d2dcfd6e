#pragma once

// Writes the timeline of a drama for other programs as OpenTimelineIO JSON (schemas of 0.15:
// Timeline.1, Stack.1, Track.1, Clip.2, Gap.1, Marker.2, TimeRange.1, RationalTime.1,
// ExternalReference.1, MissingReference.1).

#include <string>
#include <vector>

#include "shared/core/json.h"

namespace lararium::exporter {

// An item with a duration, or a moment.
struct TimelineBlock {
  std::string name;
  double begin = 0.0;  // Seconds of the drama.
  double end = 0.0;    // Seconds; a moment if it is not after `begin`.
  Json metadata = Json::object();
  std::string media = {};      // Path relative to the project; empty if there is none.
  double media_seconds = 0.0;  // Duration of the media; 0 if it is unknown.
};

struct TimelineTrack {
  std::string name;
  bool audio = false;
  std::vector<TimelineBlock> blocks;  // Any order.
};

struct ShowTimeline {
  std::string title;
  std::vector<TimelineTrack> tracks;
  std::vector<TimelineBlock> markers;  // Markers of the complete timeline.
};

// Rounds times to ticks of 1/120 s. Items that would overlap on a track go to an additional
// track of the same name. Moments become markers of their track.
Json FormatOtio(const ShowTimeline& timeline);

}  // namespace lararium::exporter
