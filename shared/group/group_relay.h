#pragma once

// The link's end of a group: a member of it that speaks with this device's player. The caller moves
// messages to and from both, and passes the time in microseconds of a steady clock.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/group/group_member.h"

namespace lararium::group {

class GroupRelay {
 public:
  explicit GroupRelay(GroupMemberOptions options) : member_(std::move(options)) {}

  // A message of another member. Error: it is not a possible one.
  Status TakeMessage(const std::string& from, std::string_view bytes, int64_t now);
  // A message of the player.
  void TakeOwn(std::string_view bytes, int64_t now);
  void Step(int64_t now) { member_.Step(now); }

  GroupMember& member() { return member_; }
  const GroupMember& member() const { return member_; }
  // Messages to the player since the last call.
  std::vector<std::string> TakeForPlayer(int64_t now);
  // The field `group` of a device's state (docs/file-formats.md).
  Json State() const;

 private:
  GroupMember member_;
  GroupPlace player_has_;
  std::vector<GroupPlace> player_said_;
  int64_t told_ = 0;  // Time at which the player was last told.
  std::string told_clock_;
};

}  // namespace lararium::group
