#include "editor/check/walk_trails.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace lararium::editor {
namespace {

constexpr float kMoved = 1e-3f;     // metres
constexpr float kTurned = 5e-3f;    // radians
constexpr float kTrailLeap = 0.1f;  // Metres in a tick that no one can walk.

bool Stands(const TrailPoint& before, const TrailPoint& now) {
  return glm::distance(before.place, now.place) < kMoved &&
         std::abs(before.heading - now.heading) < kTurned;
}

std::vector<TrailPoint>::const_iterator FirstAfter(const std::vector<TrailPoint>& points,
                                                   double seconds) {
  return std::upper_bound(
      points.begin(), points.end(), seconds,
      [](double time, const TrailPoint& point) { return time < point.seconds; });
}

// Interpolates between two points; headings take the shorter way round.
TrailPoint Mix(const TrailPoint& a, const TrailPoint& b, double seconds) {
  const auto share = static_cast<float>((seconds - a.seconds) / (b.seconds - a.seconds));
  constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;
  return {seconds, glm::mix(a.place, b.place, share),
          a.heading + share * std::remainder(b.heading - a.heading, kTurn), false};
}

}  // namespace

std::optional<TrailPoint> Trail::At(double seconds) const {
  const auto after = FirstAfter(points, seconds);
  if (after == points.begin()) {
    return std::nullopt;
  }
  const TrailPoint& before = *(after - 1);
  return after == points.end() || after->appears ? before : Mix(before, *after, seconds);
}

std::vector<TrailPoint> Trail::Between(double from, double to) const {
  std::vector<TrailPoint> way;
  if (const std::optional<TrailPoint> begin = At(from)) {
    way.push_back(*begin);
  }
  for (auto point = FirstAfter(points, from); point != points.end() && point->seconds < to;
       ++point) {
    if (point->appears) {
      way.clear();
    }
    way.push_back(*point);
  }
  if (const std::optional<TrailPoint> end = At(to)) {
    way.push_back(*end);
  }
  return way;
}

void TrailRecorder::Note(double seconds) {
  if (going_.empty()) {
    for (const stage::ActorId id : stage_.actors()) {
      going_.emplace_back().trail.actor = stage_.Find(id)->name;
    }
  }
  size_t i = 0;
  for (const stage::ActorId id : stage_.actors()) {
    const stage::ActorState& state = stage_.Find(id)->state;
    Going& going = going_[i++];
    if (state.visible) {
      Note({seconds, {state.position.x, state.position.z}, state.heading, false}, going);
    } else {
      going.last.reset();
    }
  }
}

void TrailRecorder::Note(const TrailPoint& now, Going& going) {
  std::vector<TrailPoint>& points = going.trail.points;
  const std::optional<TrailPoint> last = std::exchange(going.last, now);
  const auto keep = [&](const TrailPoint& point) {
    if (points.empty() || points.back().seconds < point.seconds) {
      points.push_back(point);
    }
  };
  if (!last || glm::distance(last->place, now.place) > kTrailLeap) {
    if (last) {
      keep(*last);
    }
    keep(now);
    points.back().appears = true;
    return;
  }
  if (Stands(points.back(), now)) {
    return;
  }
  if (Stands(points.back(), *last)) {
    keep(*last);  // The person stood until then.
  }
  if (now.seconds - points.back().seconds >= kTrailStep || Stands(*last, now)) {
    keep(now);
  }
}

std::vector<Trail> TrailRecorder::Take() {
  std::vector<Trail> trails;
  for (Going& going : going_) {
    if (going.last && going.trail.points.back().seconds < going.last->seconds) {
      going.trail.points.push_back(*going.last);
    }
    trails.push_back(std::move(going.trail));
  }
  going_.clear();
  return trails;
}

}  // namespace lararium::editor
