#include "shared/group/group_schedule.h"

#include <algorithm>
#include <cmath>

#include "shared/drama/drama.h"

namespace lararium::group {
namespace {

constexpr int64_t kSettled = 1'000'000;  // All devices know by now.

}  // namespace

double GroupSchedule::TickAt(int64_t time) const {
  if (pieces.empty()) {
    return 0.0;
  }
  const GroupPiece& piece =
      pieces.size() > 1 && time >= pieces.back().since ? pieces.back() : pieces.front();
  const double passed =
      piece.held ? 0.0
                 : 1e-6 * static_cast<double>(time - piece.since) * drama::Drama::kTicksPerSecond;
  return std::clamp(static_cast<double>(piece.tick) + passed, 0.0,
                    drama::Drama::kMaxTime * drama::Drama::kTicksPerSecond);
}

void GroupSchedule::Hold(bool held, int64_t time) {
  const auto tick = static_cast<int64_t>(std::ceil(TickAt(time)));
  if (pieces.size() > 1) {
    pieces.erase(pieces.begin());
  }
  pieces.push_back({time, tick, held});
}

void GroupSchedule::Settle(int64_t time) {
  if (pieces.size() > 1 && time > pieces.back().since + kSettled) {
    pieces.erase(pieces.begin());
  }
}

}  // namespace lararium::group
