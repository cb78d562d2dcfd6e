#include "shared/drama/sync_points.h"

#include <algorithm>

namespace lararium::drama {
namespace {

constexpr float kStrokeShare = 0.8f;  // Share of the largest distance at which the stroke begins.

}  // namespace

SyncTimes GestureTimes(const human::Clip& clip, std::span<const float> turned, double fade) {
  const double end = clip.duration;
  const double relax = std::max(0.0, end - fade);
  const auto height = std::max_element(turned.begin(), turned.end());
  if (height == turned.end() || *height <= 0.0f) {
    return {0.0, std::min(fade, relax), std::min(fade, relax), 0.5 * end, relax, relax, end};
  }
  const auto in_stroke = [&](float value) { return value >= kStrokeShare * *height; };
  const auto time_of = [&](std::span<const float>::iterator key) {
    return std::clamp(static_cast<double>(key - turned.begin()) / clip.keys_per_second, 0.0, relax);
  };
  const double begin = time_of(std::find_if(turned.begin(), turned.end(), in_stroke));
  const auto last = std::find_if(turned.rbegin(), turned.rend(), in_stroke);
  const double stop = time_of(last.base() - 1);
  return {0.0, std::min(fade, begin), begin, std::clamp(time_of(height), begin, stop), stop, relax,
          end};
}

SyncTimes SpeechTimes(const human::VisemeTrack& track) {
  const double end = track.duration;
  double first = end;
  double last = 0.0;
  double longest = 0.0;
  double middle = 0.5 * end;
  for (size_t i = 0; i < track.keys.size(); ++i) {
    if (track.keys[i].viseme == human::Viseme::kSil) {
      continue;
    }
    const double begin = track.keys[i].time;
    const double stop = i + 1 < track.keys.size() ? track.keys[i + 1].time : track.duration;
    first = std::min(first, begin);
    last = std::max(last, stop);
    const double weight = track.keys[i].strength * (stop - begin);
    if (track.keys[i].viseme >= human::Viseme::kAa && weight > longest) {
      longest = weight;
      middle = 0.5 * (begin + stop);
    }
  }
  first = std::min(first, last);
  return {0.0, first, first, std::clamp(middle, first, last), last, last, end};
}

SyncTimes PlainTimes(double seconds) {
  SyncTimes times;
  times.fill(seconds);
  times[0] = 0.0;
  return times;
}

std::optional<SyncPoint> SyncPointNamed(std::string_view name) {
  constexpr std::string_view kNames[] = {"start",      "ready", "stroke_start", "stroke",
                                         "stroke_end", "relax", "end"};
  for (int i = 0; i < stage::kSyncPoints; ++i) {
    if (kNames[i] == name) {
      return static_cast<SyncPoint>(i);
    }
  }
  return std::nullopt;
}

}  // namespace lararium::drama
