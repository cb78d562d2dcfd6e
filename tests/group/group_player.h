#pragma once

// What a player does for a group, without pictures: a drama on a stage that follows the group.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/log.h"
#include "shared/drama/drama.h"
#include "shared/group/group_feed.h"
#include "shared/show/drama_group.h"
#include "shared/stage/stage.h"

namespace lararium::test {

// A visitor who walks about and looks around. seed: of the walk.
drama::Visitor WanderingVisitor(uint64_t seed, double seconds);

class GroupPlayer {
 public:
  // steady: seconds of the device's clock.
  explicit GroupPlayer(std::function<double()> steady);

  group::GroupFeed& feed() { return feed_; }
  // A frame. Keys are those of the visitor.
  void Frame(const drama::Visitor& visitor);
  // A message to the link, which is to be sent.
  std::string TakeOwn();

  double seconds() const { return seconds_; }  // Time of the drama at the last frame.
  const drama::Drama& drama() const { return *drama_; }
  // Frames in which the drama's time went back, or on by more than a quarter of a second, since the
  // group went to another moment.
  int64_t backwards() const { return backwards_; }
  int64_t jumps() const { return jumps_; }
  // Hashes of the states of two seconds ago, by run and tick.
  const std::map<std::pair<uint64_t, int64_t>, uint64_t>& marks() const { return marks_; }

 private:
  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::function<double()> steady_;
  group::GroupFeed feed_;
  stage::Stage stage_;
  std::unique_ptr<drama::Drama> drama_;
  std::unique_ptr<show::GroupSeat> seat_;
  double seconds_ = 0.0;
  int64_t backwards_ = 0;
  int64_t jumps_ = 0;
  uint64_t run_ = 0;
  std::map<std::pair<uint64_t, int64_t>, uint64_t> marks_;
};

// Number of states of which players have different hashes, of those that at least two have; from:
// time of the drama from which states are compared, seconds.
struct ComparedStates {
  size_t compared = 0;
  size_t different = 0;
};
ComparedStates Compare(const std::vector<const GroupPlayer*>& players, double from = 0.0);

}  // namespace lararium::test
