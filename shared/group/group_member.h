#pragma once

// A device's part in a group that plays one drama (docs/internals/group.md): its clock, its copy of
// the log, who leads, and what is sent when. No sockets and no clocks: the caller passes messages
// and the time, in microseconds of a steady clock.

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shared/group/group_clock.h"
#include "shared/group/group_log.h"
#include "shared/group/group_message.h"
#include "shared/group/group_schedule.h"
#include "shared/group/own_events.h"

namespace lararium::group {

struct GroupMemberOptions {
  std::string name;
  bool guide = false;
  uint64_t boot = 0;              // A random number.
  std::function<int64_t()> wall;  // Microseconds since 1970, for a group that begins.
};

class GroupMember {
 public:
  // Events apply this much later than the leader hears of them, so that they reach all in time.
  static constexpr int64_t kMargin = 250'000;
  // A member that is silent for this time is gone.
  static constexpr int64_t kSilence = 2'000'000;
  // Who finds no leader in this time begins a group.
  static constexpr int64_t kListen = 1'500'000;

  struct Outgoing {
    std::string to;  // Empty: all members.
    std::string bytes;
    bool reliable = false;
  };

  explicit GroupMember(GroupMemberOptions options);

  void Receive(const std::string& from, const GroupMessage& message, int64_t now);
  // The broker says that a device is gone.
  void SetGone(const std::string& name);
  // What the player says. Until it has spoken, and if it is silent for seconds, this device is not
  // a member.
  void SetOwn(const GroupOwn& own, int64_t now);
  // A command of the staff. to_all: all members have got it, so that the leader is enough.
  void Want(GroupWish::What what, const std::string& marker, bool to_all, int64_t now);
  // Does what is due. Call it every 20 ms and after messages.
  void Step(int64_t now);

  // Messages, and texts for the log, since the last call.
  std::vector<Outgoing> TakeOutgoing() { return std::exchange(outgoing_, {}); }
  std::vector<std::string> TakeNotes() { return std::exchange(notes_, {}); }

  bool has_player() const { return own_.has_value(); }
  // The log and the clock are those of the group.
  bool ready() const { return ready_; }
  bool leads() const { return leads_; }
  const std::string& leader() const { return leader_; }  // Empty: there is none.
  size_t members() const;                                // Number of members, with this one.
  const GroupLog& log() const { return log_; }
  std::span<const GroupOwn::Marker> markers() const {
    return own_ ? own_->markers : std::span<const GroupOwn::Marker>();
  }
  const GroupSchedule& schedule() const { return schedule_; }
  // The drama's tick at a time, if ready().
  double TickAt(int64_t now) const { return schedule_.TickAt(clock_.GroupTime(now)); }
  // The schedule by the own clock, for the player; nullopt: not ready.
  std::optional<GroupClockNews> ClockNews() const;

 private:
  struct Peer {
    GroupBeat beat;
    int64_t heard = 0;
    int64_t came = 0;  // The group's time at which the last beat came; 0: none for an echo.
    bool gone = false;
    int64_t answered = 0;        // Time at which it last got a part of the log.
    uint64_t answered_from = 0;  // Index of the first entry of that part.
    int64_t wished = 0;          // GroupWish::sent of its last wish.
    int differs = 0;             // Marks that differed from the own ones.
    uint64_t marked = 0;         // Hash of its last mark that was compared.
    int64_t second_began = 0;    // Events are counted since then, if it is a page.
    size_t in_second = 0;
  };
  // How good a leader is, or would be.
  struct Rank {
    bool page = false;
    bool guide = false;
    int followers = 0;
    int64_t since = 0;
    std::string name;

    bool IsBetterThan(const Rank& other) const;
  };
  Rank OwnRank() const;
  static Rank RankOf(const std::string& name, const Peer& peer);
  bool IsAlive(const Peer& peer) const;
  // A museum's device never follows a page, whose account is public.
  bool MayLead(const std::string& name) const { return !IsPage(name) || IsPage(options_.name); }
  // True if one more device or page can be a member.
  bool HasRoomFor(const std::string& name) const;
  // Counts events of a page. False: it sends too many.
  static bool MayAct(Peer& page, size_t events, int64_t now);
  int Followers() const;

  void Elect(int64_t now);
  void ElectWithoutLeader(int64_t now);
  void Begin(int64_t now);
  void TakeOver(int64_t now);
  void Follow(const std::string& leader, int64_t now);

  void TakeBeat(const std::string& from, const GroupBeat& beat, int64_t now);
  void TakeLeadersBeat(const Peer& leader, int64_t now);
  void TakeLog(const std::string& from, const GroupLogPart& part, int64_t now);
  void Answer(const std::string& to, const GroupAsk& ask, int64_t now);
  void TakeWish(const std::string& from, const GroupWish& wish, int64_t now);
  void CompareMarks(const std::string& name, Peer& peer);

  // The leader calls these.
  void Order(const std::string& name, const GroupEvents& events, int64_t now);
  void Fulfil(const std::string& from, const GroupWish& wish, int64_t now);
  void GoTo(int64_t tick, int64_t now);
  void Hold(bool held, int64_t now);
  void KeepLog(int64_t now);
  int32_t NextTick(int64_t now) const;

  void SendBeat(int64_t now);
  // Sends the log from an entry on, as far as a message goes. Returns the number of entries.
  size_t SendPart(const std::string& to, size_t from);
  void SendAsk(int64_t now);
  void Send(const std::string& to, const GroupMessage& message, bool reliable);

  GroupMemberOptions options_;
  GroupClock clock_;
  GroupLog log_;
  std::map<std::string, Peer> peers_;

  // The player.
  std::optional<GroupOwn> own_;
  int64_t own_came_ = 0;
  int64_t now_ = 0;              // Time of the last call.
  std::deque<GroupMark> marks_;  // Own marks of this run, newest last.
  OwnEvents events_;

  // Leadership.
  bool leads_ = false;
  bool ready_ = false;
  std::string leader_;
  uint64_t epoch_ = 0;
  int64_t since_ = 0;
  int64_t listening_since_ = 0;  // Zero means not yet.
  int64_t leaderless_since_ = 0;

  // The drama.
  GroupSchedule schedule_;
  int64_t moved_ = 0;  // Time at which the leader last went to another moment.
  uint64_t runs_ = 0;
  size_t told_ = 0;  // Entries of the log that the leader has sent to all.
  int32_t minute_ = -1;

  // The log of a follower.
  int64_t missing_since_ = 0;  // 0: nothing is missing.
  int64_t surplus_since_ = 0;  // 0: there are no entries that the leader has not.
  int64_t asked_ = 0;

  int64_t next_beat_ = 0;
  std::vector<Outgoing> outgoing_;
  std::vector<std::string> notes_;
  bool other_show_told_ = false;
  bool full_told_ = false;
};

}  // namespace lararium::group
