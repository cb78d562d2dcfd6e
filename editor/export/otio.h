#pragma once

// A drama's timeline for other programs: OpenTimelineIO's JSON (schemas of 0.15: Timeline.1,
// Stack.1, Track.1, Clip.2, Gap.1, Marker.2, TimeRange.1, RationalTime.1,
// ExternalReference.1, MissingReference.1).

#include <string>
#include <vector>

#include "shared/core/json.h"

namespace lararium::exporter {

// Something that lasts, or a moment.
struct TimelineBlock {
  std::string name;
  double begin = 0.0;  // seconds of the drama
  double end = 0.0;    // not above begin: a moment
  Json metadata = Json::object();
  std::string media = {};      // relative to the project; empty: there is none
  double media_seconds = 0.0;  // how long that is; 0: not known
};

struct TimelineTrack {
  std::string name;
  bool audio = false;
  std::vector<TimelineBlock> blocks;  // in any order
};

struct ShowTimeline {
  std::string title;
  std::vector<TimelineTrack> tracks;
  std::vector<TimelineBlock> markers;  // of all
};

// Times are whole ticks, of 120 a second. What would overlap on a track goes to a further
// one of its name. Moments are markers of their track.
Json FormatOtio(const ShowTimeline& timeline);

}  // namespace lararium::exporter
