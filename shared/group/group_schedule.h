#pragma once

// Where a group's drama is at a time of the group, microseconds.

#include <cstdint>
#include <vector>

#include "shared/group/group_message.h"

namespace lararium::group {

struct GroupSchedule {
  uint64_t run = 0;                // 0: there is none yet.
  std::vector<GroupPiece> pieces;  // One, or two: what follows.

  double TickAt(int64_t time) const;
  // Whether the drama is held at a time, or will be.
  bool held() const { return !pieces.empty() && pieces.back().held; }
  // Holds the drama, or lets it go on, from a time on.
  void Hold(bool held, int64_t time);
  // Forgets the first piece when the second has begun.
  void Settle(int64_t time);
};

}  // namespace lararium::group
