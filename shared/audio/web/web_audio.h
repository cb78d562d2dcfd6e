#pragma once

// The time of a page's sound.

namespace lararium::audio {

// Seconds.
struct WebAudioTimes {
  double head = 0.0;     // Time of the context up to which the graph has been scheduled.
  double now = 0.0;      // Present time of the context; it stands while the page suspends it.
  double latency = 0.0;  // Time until samples of the present are heard.
};
WebAudioTimes ReadWebAudioTimes();

}  // namespace lararium::audio
