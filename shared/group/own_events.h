#pragma once

// What the visitor of this device did that the group is to know, until it is in the group's log.

#include <cstdint>
#include <deque>
#include <string>

#include "shared/group/group_log.h"
#include "shared/group/group_message.h"

namespace lararium::group {

// Times are microseconds of a steady clock.
class OwnEvents {
 public:
  explicit OwnEvents(uint64_t boot) : boot_(boot) {}

  // The visitor is there. A pose that hardly differs from the last, or comes soon after it, is left
  // out. members: of the group, which share the messages.
  void SetPose(const GroupEntry& pose, size_t members, int64_t now);
  void AddKey(const std::string& text, int64_t now);
  // What the log does not have yet is to be sent at once, to another leader.
  void SendAgain() { due_ = true; }
  // The events to be sent now, in the order of their serials; empty: none. name: of this device.
  GroupEvents Take(const GroupLog& log, const std::string& name, int64_t now);

 private:
  struct Key {
    uint16_t serial = 0;
    std::string text;
    int64_t born = 0;
  };

  uint64_t boot_;
  uint16_t serial_ = 0;
  bool has_pose_ = false;
  GroupEntry pose_;
  int64_t posed_ = 0;
  std::deque<Key> keys_;
  bool due_ = false;
  int64_t sent_ = 0;
};

}  // namespace lararium::group
