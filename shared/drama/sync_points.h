#pragma once

// Times of the seven synchronisation points of an action (Behavior Markup Language 1.0, section
// 4.2): start, ready for the stroke, start, peak and end of the stroke (the essential part), relax,
// end.

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "shared/human/face.h"
#include "shared/human/human.h"
#include "shared/stage/sync_point.h"

namespace lararium::drama {

using stage::SyncPoint;

// Seconds from the start of an action to each of its points; ascending.
using SyncTimes = std::array<double, stage::kSyncPoints>;

// Points of a clip. The stroke lasts while the joints are near their largest distance from the
// first frame; its peak is the moment of the largest distance. turned: human::TurnedFromFirst of
// the clip. fade: duration of fade-in and fade-out, seconds.
SyncTimes GestureTimes(const human::Clip& clip, std::span<const float> turned, double fade);

// Points of speech. The stroke lasts from the first sound to the last; its peak is the middle of
// the longest open sound.
SyncTimes SpeechTimes(const human::VisemeTrack& track);

// Points of an action of given duration without a stroke of its own: the stroke is at its end.
SyncTimes PlainTimes(double seconds);

std::optional<SyncPoint> SyncPointNamed(std::string_view name);

}  // namespace lararium::drama
