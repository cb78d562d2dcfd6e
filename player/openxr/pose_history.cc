#include "player/openxr/pose_history.h"

#include <algorithm>

namespace lararium::player {

void PoseHistory::Add(int64_t time_ns, const geometry::Rigid3& pose) {
  if (!entries_.empty() && time_ns <= entries_.back().time_ns) {
    return;
  }
  entries_.push_back({time_ns, pose});
  while (entries_.front().time_ns < time_ns - kLongest) {
    entries_.pop_front();
  }
}

std::optional<geometry::Rigid3> PoseHistory::At(int64_t time_ns) const {
  if (entries_.empty()) {
    return std::nullopt;
  }
  const auto after = std::find_if(entries_.begin(), entries_.end(),
                                  [=](const Entry& e) { return e.time_ns >= time_ns; });
  if (after == entries_.begin()) {
    return after->pose;
  }
  if (after == entries_.end()) {
    return entries_.back().pose;
  }
  const Entry& before = *(after - 1);
  const double share = static_cast<double>(time_ns - before.time_ns) /
                       static_cast<double>(after->time_ns - before.time_ns);
  return geometry::Rigid3{
      before.pose.rotation.slerp(share, after->pose.rotation),
      (1.0 - share) * before.pose.translation + share * after->pose.translation};
}

}  // namespace lararium::player
