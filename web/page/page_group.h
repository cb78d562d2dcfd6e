#pragma once

// A page's part in a group of devices that plays one drama (docs/internals/group.md). JavaScript
// moves the messages between it and the broker.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/group/group_feed.h"
#include "shared/group/group_relay.h"

namespace lararium::web {

class PageGroup {
 public:
  // steady: microseconds of the clock that the feed's group has. Borrows feed.
  PageGroup(group::GroupMemberOptions options,
            group::GroupFeed& feed,
            std::function<int64_t()> steady)
      : relay_(std::move(options)), feed_(feed), steady_(std::move(steady)) {}

  // A message of another member. Those that are not possible are ignored.
  void Take(const std::string& from, std::string_view bytes);
  // The broker says that a member is gone.
  void SetGone(const std::string& name) { relay_.member().SetGone(name); }
  // A command of the staff. to_all: see GroupMember::Want.
  void Want(group::GroupWish::What what, const std::string& marker, bool to_all);
  // Exchanges news with the show, and does what is due. Call it every 20 ms while the show plays.
  void Step();
  // Messages to be sent since the last call.
  std::vector<group::GroupMember::Outgoing> TakeOutgoing() {
    return relay_.member().TakeOutgoing();
  }
  // See GroupRelay::State().
  Json State() const { return relay_.State(); }

 private:
  group::GroupRelay relay_;
  group::GroupFeed& feed_;
  std::function<int64_t()> steady_;
};

}  // namespace lararium::web
