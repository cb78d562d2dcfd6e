#include "editor/session/point_trails.h"

#include <algorithm>
#include <utility>

namespace lararium::editor {

void PointTrails::Add(int64_t frame, uint32_t map, std::span<const vision::SeenPoint> seen) {
  if (frame != frame_ + 1 || map != map_) {
    trails_.clear();
  }
  frame_ = frame;
  map_ = map;
  std::vector<PointTrail> now;
  now.reserve(seen.size());
  for (const vision::SeenPoint& point : seen) {
    now.push_back({point.point, {point.pixel}});
  }
  std::sort(now.begin(), now.end(),
            [](const PointTrail& a, const PointTrail& b) { return a.point < b.point; });
  auto before = trails_.begin();
  for (PointTrail& trail : now) {
    while (before != trails_.end() && before->point < trail.point) {
      ++before;
    }
    if (before != trails_.end() && before->point == trail.point) {
      const size_t kept = std::min(before->pixels.size(), kLongest - 1);
      trail.pixels.insert(trail.pixels.end(), before->pixels.begin(),
                          before->pixels.begin() + static_cast<std::ptrdiff_t>(kept));
    }
  }
  trails_ = std::move(now);
}

}  // namespace lararium::editor
