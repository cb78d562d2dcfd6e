#pragma once

// The seven moments of a behaviour by which others are timed (Behavior Markup Language
// 1.0, section 4.2, "synchronisation points"): it starts; is ready for its stroke; the
// stroke, the part that matters, begins, is at its height, ends; it relaxes; it ends.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "shared/human/face.h"
#include "shared/human/human.h"
#include "shared/stage/sync_point.h"

namespace lararium::drama {

using stage::SyncPoint;

// Seconds after its start at which a behaviour reaches each point; ascending.
using SyncTimes = std::array<double, stage::kSyncPoints>;

// Of a clip: the stroke is while its joints are furthest from where they were at first,
// within a share of the largest distance; its height is the moment of the largest.
// turned: human::TurnedFromFirst of the clip. fade: seconds that it takes to come and go.
SyncTimes GestureTimes(const human::Clip& clip, std::span<const float> turned, double fade);

// Of speech: the stroke lasts from the first sound to the last; its height is the middle
// of the longest open sound.
SyncTimes SpeechTimes(const human::VisemeTrack& track);

// What takes so many seconds and has no stroke of its own: all is there in the end.
SyncTimes PlainTimes(double seconds);

std::optional<SyncPoint> SyncPointNamed(std::string_view name);

}  // namespace lararium::drama
