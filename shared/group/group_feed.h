#pragma once

// The player's end of a group: keeps the log that the link sends, and passes what it says on to the
// show (show::DramaGroup); packs what the show says for the link.

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/group/group_log.h"
#include "shared/group/group_message.h"
#include "shared/show/drama_group.h"

namespace lararium::group {

// Any thread, except for the functions of the link, which one thread calls.
class GroupFeed {
 public:
  // steady: seconds of CLOCK_MONOTONIC, which the link reads as well.
  explicit GroupFeed(std::function<double()> steady) : group_(std::move(steady)) {}

  show::DramaGroup& group() { return group_; }

  // What is played. show: the same for all players whose dramas are the same if their visitors are.
  void SetShow(std::string show, std::vector<GroupOwn::Marker> markers);
  // A visitor is present.
  void SetVisited(bool visited);

  // ---- for the link ----

  // A message for the link; empty: the show has not begun.
  std::string TakeOwn();
  // A message of the link. Others are ignored.
  void Take(std::string_view bytes);

 private:
  show::DramaGroup group_;
  std::mutex mutex_;
  GroupOwn own_;  // Values that SetShow() and SetVisited() have set.
  // Used by the link's thread only.
  int64_t messages_ = 0;
  GroupLog log_;
  GroupLogReader reader_;
  std::optional<GroupLog::Change> changed_;  // The show does not know of it yet.
};

// The markers of a drama, with their ticks.
std::vector<GroupOwn::Marker> MarkersOf(std::string_view script);

}  // namespace lararium::group
