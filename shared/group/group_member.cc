#include "shared/group/group_member.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "shared/drama/drama.h"

namespace lararium::group {
namespace {

constexpr int64_t kSecond = 1'000'000;
constexpr int64_t kBeat = 200'000;
constexpr int64_t kQuickBeat = 100'000;  // A member that is not ready needs the time soon.
constexpr size_t kBeatMembers = 8;       // Larger groups beat less often.
constexpr int64_t kSilentPlayer = 5 * kSecond;
constexpr int64_t kLeaveAfter = 5 * kSecond;
constexpr int64_t kForgetAfter = 60 * kSecond;
constexpr int64_t kLate = 250'000;  // A part of the log is late, and is asked for.
constexpr int64_t kAskAgain = 800'000;
constexpr int64_t kAnswerAgain = 400'000;
// Every member is to hear of a hold before it begins, because dramas do not go back.
constexpr int64_t kHoldMargin = 500'000;
constexpr int64_t kSurplus = kSecond;  // Entries that the leader still has not are dropped.
constexpr int64_t kOthersClaim = kSecond;
constexpr int kExchanges = 2;  // The group's time is known well enough after these.
constexpr size_t kMostMarks = 16;
constexpr size_t kMostPageEvents = 16;  // Events of a page in a second.
constexpr int kTellDiffering = 10;      // Some states differ after a split, until all have one log.
constexpr size_t kMostPoses = GroupLog::kMostEntries - 4096;  // Keys have room behind them.

uint64_t Mixed(uint64_t boot, uint64_t number) {
  uint64_t x = boot + number * 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  return (x ^ (x >> 27)) | 1;
}

}  // namespace

GroupMember::GroupMember(GroupMemberOptions options)
    : options_(std::move(options)), events_(options_.boot) {}

bool GroupMember::Rank::IsBetterThan(const Rank& other) const {
  return std::tie(page, other.guide, other.followers, since, name) <
         std::tie(other.page, guide, followers, other.since, other.name);
}

// The guide's device leads rather than others, but of two groups a lone guide's does not count:
// that device has just been switched on.
GroupMember::Rank GroupMember::OwnRank() const {
  const int followers = leads_ ? Followers() : 0;
  return {IsPage(options_.name), options_.guide && ready_ && (followers > 0 || !leads_), followers,
          since_, options_.name};
}

GroupMember::Rank GroupMember::RankOf(const std::string& name, const Peer& peer) {
  const GroupBeat& beat = peer.beat;
  const bool page = IsPage(name);
  return {page, !page && beat.guide && beat.ready && (beat.followers > 0 || !beat.leads),
          beat.followers, beat.since, name};
}

bool GroupMember::IsAlive(const Peer& peer) const {
  return !peer.gone && now_ - peer.heard < kSilence;
}

int GroupMember::Followers() const {
  return static_cast<int>(std::count_if(peers_.begin(), peers_.end(), [this](const auto& one) {
    return IsAlive(one.second) && one.second.beat.leader == options_.name;
  }));
}

size_t GroupMember::members() const {
  return 1 + static_cast<size_t>(std::count_if(peers_.begin(), peers_.end(), [this](const auto& p) {
           return IsAlive(p.second);
         }));
}

std::optional<GroupClockNews> GroupMember::ClockNews() const {
  if (!ready_) {
    return std::nullopt;
  }
  GroupClockNews news{schedule_.run, {}};
  for (const GroupPiece& piece : schedule_.pieces) {
    news.pieces.push_back({1e-6 * static_cast<double>(clock_.OwnTime(piece.since)),
                           static_cast<double>(piece.tick) / drama::Drama::kTicksPerSecond,
                           piece.held ? 0.0 : 1.0 + clock_.drift()});
  }
  return news;
}

// ---- messages

void GroupMember::Receive(const std::string& from, const GroupMessage& message, int64_t now) {
  if (from == options_.name || !own_) {
    return;
  }
  now_ = now;
  if (const auto* beat = std::get_if<GroupBeat>(&message)) {
    TakeBeat(from, *beat, now);
    return;
  }
  const auto peer = peers_.find(from);
  if (peer == peers_.end()) {
    return;
  }
  if (const auto* log = std::get_if<GroupLogPart>(&message)) {
    TakeLog(from, *log, now);
  } else if (const auto* events = std::get_if<GroupEvents>(&message)) {
    const size_t count = events->events.entries.size();
    if (events->boot == peer->second.beat.boot &&
        (!IsPage(from) || MayAct(peer->second, count, now))) {
      Order(from, *events, now);
    }
  } else if (const auto* ask = std::get_if<GroupAsk>(&message)) {
    Answer(from, *ask, now);
  } else if (const auto* wish = std::get_if<GroupWish>(&message)) {
    TakeWish(from, *wish, now);
  }
}

bool GroupMember::MayAct(Peer& page, size_t events, int64_t now) {
  if (now - page.second_began > kSecond) {
    page.second_began = now;
    page.in_second = 0;
  }
  page.in_second += events;
  return page.in_second <= kMostPageEvents;
}

void GroupMember::SetGone(const std::string& name) {
  if (const auto peer = peers_.find(name); peer != peers_.end()) {
    peer->second.gone = true;
  }
}

void GroupMember::TakeBeat(const std::string& from, const GroupBeat& beat, int64_t now) {
  if (beat.show != own_->show) {
    if (!IsPage(from) && !std::exchange(other_show_told_, true)) {
      notes_.push_back("\"" + from +
                       "\" plays another show or another version of it than this "
                       "device; they do not play together");
    }
    return;
  }
  if (!peers_.contains(from) && !HasRoomFor(from)) {
    return;
  }
  Peer& peer = peers_[from];
  if (peer.beat.boot == beat.boot && beat.sent <= peer.beat.sent) {
    return;  // A beat that came before.
  }
  if (peer.beat.boot != beat.boot) {
    peer = {};  // The device was switched on again, and its clock may begin again.
  }
  peer.beat = beat;
  peer.heard = now;
  peer.gone = false;
  peer.came = leads_ ? clock_.GroupTime(now) : 0;
  epoch_ = leads_ ? epoch_ : std::max(epoch_, beat.epoch);
  CompareMarks(from, peer);
  Elect(now);
  if (from == leader_) {
    TakeLeadersBeat(peer, now);
  }
}

bool GroupMember::HasRoomFor(const std::string& name) const {
  const bool page = IsPage(name);
  const auto others = std::count_if(peers_.begin(), peers_.end(),
                                    [&](const auto& one) { return IsPage(one.first) == page; });
  const size_t own = IsPage(options_.name) == page ? 1 : 0;
  return static_cast<size_t>(others) + own < (page ? kMostGroupPages : kMostGroupMembers);
}

void GroupMember::TakeLeadersBeat(const Peer& leader, int64_t now) {
  const GroupBeat& beat = leader.beat;
  for (const GroupBeat::Echo& echo : beat.echoes) {
    if (echo.name == options_.name && echo.sent <= now && echo.sent > now - 10 * kSecond) {
      clock_.Add({echo.sent, echo.received, beat.time, now});
    }
  }
  const bool has_all = log_.Has(beat.log);
  if (!has_all) {
    missing_since_ = missing_since_ == 0 ? now : missing_since_;
    if (!ready_ || beat.run != schedule_.run || now - missing_since_ > kLate) {
      SendAsk(now);
    }
    return;
  }
  missing_since_ = 0;
  if (beat.run != schedule_.run) {
    log_.Truncate(beat.log.count);
    schedule_.run = beat.run;
    marks_.clear();
    events_.SendAgain();
  }
  schedule_.pieces = beat.pieces;
  if (log_.size() == beat.log.count) {
    surplus_since_ = 0;
  } else if (surplus_since_ == 0) {
    surplus_since_ = now;
  } else if (now - surplus_since_ > kSurplus) {
    log_.Truncate(beat.log.count);
    surplus_since_ = 0;
  }
  if (!ready_ && clock_.exchanges() >= kExchanges) {
    ready_ = true;
    since_ = clock_.GroupTime(now);
    next_beat_ = now;
  }
}

void GroupMember::TakeLog(const std::string& from, const GroupLogPart& part, int64_t now) {
  if (from != leader_ || leads_) {
    return;
  }
  const GroupBeat& beat = peers_.at(from).beat;
  if (part.epoch != beat.epoch || part.run != beat.run) {
    return;  // Nothing follows from a leadership or a run that is over or not known yet.
  }
  if (!log_.Has(part.before)) {
    missing_since_ = missing_since_ == 0 ? now : missing_since_;
    return;
  }
  log_.Take(part.before.count, part.part);
  asked_ = std::max(asked_, now - kAskAgain + kLate);  // More may be under way.
}

void GroupMember::Answer(const std::string& to, const GroupAsk& ask, int64_t now) {
  Peer& peer = peers_.at(to);
  size_t from = log_.CommonWith(ask.places);
  if (!leads_ || (now - peer.answered < kAnswerAgain && from == peer.answered_from)) {
    return;
  }
  peer.answered = now;
  peer.answered_from = from;
  while (from < log_.size()) {
    from += SendPart(to, from);
  }
}

void GroupMember::TakeWish(const std::string& from, const GroupWish& wish, int64_t now) {
  Peer& peer = peers_.at(from);
  if (wish.boot == peer.beat.boot && wish.sent > peer.wished) {
    peer.wished = wish.sent;
    Fulfil(from, wish, now);
  }
}

void GroupMember::CompareMarks(const std::string& name, Peer& peer) {
  if (IsPage(name) || IsPage(options_.name)) {
    return;  // Browsers compute in other last digits than processors do.
  }
  const GroupMark& theirs = peer.beat.mark;
  const auto own = std::find_if(marks_.begin(), marks_.end(),
                                [&](const GroupMark& mark) { return mark.tick == theirs.tick; });
  if (peer.beat.run != schedule_.run || own == marks_.end() || theirs.hash == peer.marked) {
    return;
  }
  peer.marked = theirs.hash;
  peer.differs = own->hash == theirs.hash ? 0 : peer.differs + 1;
  if (peer.differs == kTellDiffering) {
    notes_.push_back("\"" + name +
                     "\" does not play what this device plays; both need the same "
                     "program on processors of the same kind");
  }
}

// ---- the player

void GroupMember::SetOwn(const GroupOwn& own, int64_t now) {
  if (own_ && own_->show != own.show) {
    peers_.clear();  // Another show has another group.
    leads_ = ready_ = false;
    leader_.clear();
    schedule_ = {};
    log_ = {};
    listening_since_ = 0;
  }
  std::vector<GroupOwn::Marker> markers =
      own.markers.empty() && own_ ? std::move(own_->markers) : own.markers;
  own_ = own;
  own_->markers = std::move(markers);
  own_came_ = now;
  events_.SetPose(own.visitor, members(), now);
  for (const std::string& key : own.keys) {
    events_.AddKey(key, now);
  }
  if (own.mark_run == schedule_.run && own.mark.tick > 0 &&
      (marks_.empty() || marks_.back().tick < own.mark.tick)) {
    marks_.push_back(own.mark);
    if (marks_.size() > kMostMarks) {
      marks_.pop_front();
    }
  }
  if (own.restart) {
    Want(options_.guide ? GroupWish::What::kRestart : GroupWish::What::kRestartAlone, "", false,
         now);
  }
}

void GroupMember::Want(GroupWish::What what, const std::string& marker, bool to_all, int64_t now) {
  const GroupWish wish = {options_.boot, now, what, marker};
  if (leads_) {
    Fulfil(options_.name, wish, now);
  } else if (!to_all && !leader_.empty()) {
    Send(leader_, wish, true);
  }
}

void GroupMember::Step(int64_t now) {
  now_ = now;
  if (!own_ || now - own_came_ > kSilentPlayer) {
    leads_ = false;  // A device without a player must not lead.
    leader_.clear();
    return;
  }
  listening_since_ = listening_since_ == 0 ? now : listening_since_;
  std::erase_if(peers_, [&](const auto& one) { return now - one.second.heard > kForgetAfter; });
  Elect(now);
  const GroupEvents events =
      leader_.empty() ? GroupEvents() : events_.Take(log_, options_.name, now);
  if (leads_) {
    Order(options_.name, events, now);
    KeepLog(now);
  } else if (!events.events.entries.empty()) {
    Send(leader_, events, true);
  }
  if (now >= next_beat_) {
    SendBeat(now);  // Others take news of the log only if they know who leads.
  }
  while (leads_ && told_ < log_.size()) {
    told_ += SendPart("", told_);
  }
}

// ---- who leads

void GroupMember::Elect(int64_t now) {
  std::optional<Rank> best = leads_ ? std::optional(OwnRank()) : std::nullopt;
  for (const auto& [name, peer] : peers_) {
    if (MayLead(name) && IsAlive(peer) && peer.beat.leads) {
      Rank rank = RankOf(name, peer);
      best = !best || rank.IsBetterThan(*best) ? std::move(rank) : *best;
    }
  }
  if (!best) {
    ElectWithoutLeader(now);
    return;
  }
  leaderless_since_ = 0;
  if (best->name != options_.name && best->name != leader_) {
    Follow(best->name, now);
  }
}

void GroupMember::ElectWithoutLeader(int64_t now) {
  leader_.clear();
  leaderless_since_ = leaderless_since_ == 0 ? now : leaderless_since_;
  const Rank own = OwnRank();
  const bool other_claims = std::any_of(peers_.begin(), peers_.end(), [&](const auto& one) {
    return MayLead(one.first) && IsAlive(one.second) && one.second.beat.ready &&
           (!ready_ || RankOf(one.first, one.second).IsBetterThan(own));
  });
  const bool waits = other_claims && now - leaderless_since_ < kOthersClaim;
  if (ready_ && !waits) {
    TakeOver(now);
  } else if (!ready_ && !waits && now - listening_since_ >= kListen) {
    Begin(now);
  }
}

void GroupMember::Begin(int64_t now) {
  clock_.Begin(now, options_.wall());
  since_ = clock_.GroupTime(now);
  ++epoch_;
  leads_ = ready_ = true;
  leader_ = options_.name;
  log_.Truncate(0);
  told_ = 0;
  schedule_ = {Mixed(options_.boot, ++runs_), {{since_, 0, false}}};
  next_beat_ = now;
}

void GroupMember::TakeOver(int64_t now) {
  clock_.Lead(now);
  ++epoch_;
  leads_ = true;
  leader_ = options_.name;
  leaderless_since_ = 0;
  told_ = log_.size();
  missing_since_ = surplus_since_ = 0;
  events_.SendAgain();
  next_beat_ = now;
}

void GroupMember::Follow(const std::string& leader, int64_t now) {
  leads_ = false;
  leader_ = leader;
  epoch_ = peers_.at(leader).beat.epoch;
  missing_since_ = surplus_since_ = asked_ = 0;
  events_.SendAgain();
  next_beat_ = now;
}

// ---- what the leader does

int32_t GroupMember::NextTick(int64_t now) const {
  const double soon = std::ceil(TickAt(now + kMargin));
  const double next = std::floor(TickAt(now)) + 1.0;
  return std::max(log_.last_tick(), static_cast<int32_t>(std::max(soon, next)));
}

void GroupMember::Order(const std::string& name, const GroupEvents& events, int64_t now) {
  if (!leads_ || events.events.entries.empty()) {
    return;
  }
  const int32_t tick = NextTick(now);
  if (log_.FindPresent(name, events.boot) == nullptr && !log_.Join(tick, name, events.boot)) {
    return;
  }
  const auto who = static_cast<uint8_t>(log_.Find(name) - log_.devices().data());
  size_t text = 0;
  for (GroupEntry entry : events.events.entries) {
    const std::string words = entry.has_text() ? events.events.texts[text++] : "";
    const std::optional<uint16_t>& last = log_.devices()[who].serial;
    const bool is_key = entry.kind == GroupEntry::Kind::kKey;
    const bool fits = is_key || log_.size() < kMostPoses;
    if (!fits && !std::exchange(full_told_, true)) {
      notes_.push_back(
          "the drama has gone on for so long that visitors' steps no longer count; "
          "begin it again");
    }
    // While the drama is held, poses wait: their senders repeat the last one.
    if ((last && !IsLaterSerial(entry.serial, *last)) || !fits || (!is_key && schedule_.held())) {
      continue;
    }
    entry.tick = tick;
    entry.who = who;
    log_.Append(entry, words);
  }
}

void GroupMember::Fulfil(const std::string& from, const GroupWish& wish, int64_t now) {
  using What = GroupWish::What;
  const bool allowed = from == options_.name || !IsPage(from) || wish.what == What::kRestartAlone;
  if (!leads_ || !allowed) {
    return;
  }
  if (wish.what == What::kHold || wish.what == What::kResume) {
    Hold(wish.what == What::kHold, now);
    return;
  }
  if (wish.what == What::kGoTo) {
    const auto found =
        std::find_if(own_->markers.begin(), own_->markers.end(),
                     [&](const GroupOwn::Marker& marker) { return marker.name == wish.marker; });
    if (found == own_->markers.end()) {
      notes_.push_back("the drama has no marker \"" + wish.marker + "\"");
    } else {
      GoTo(found->tick, now);
    }
    return;
  }
  const bool others = (from != options_.name && own_->visited) ||
                      std::any_of(peers_.begin(), peers_.end(), [&](const auto& one) {
                        return one.first != from && IsAlive(one.second) && one.second.beat.visited;
                      });
  if (wish.what == What::kRestart || !others) {
    GoTo(0, now);
  }
}

// Several devices may ask for it at once.
void GroupMember::GoTo(int64_t tick, int64_t now) {
  if (moved_ != 0 && now - moved_ < kSecond) {
    return;
  }
  moved_ = now;
  schedule_ = {Mixed(options_.boot, ++runs_), {{clock_.GroupTime(now + kMargin), tick, false}}};
  log_.TruncateAfter(static_cast<int32_t>(tick));
  told_ = log_.size();
  minute_ = -1;
  full_told_ = false;
  marks_.clear();
  events_.SendAgain();
  next_beat_ = now;
}

void GroupMember::Hold(bool held, int64_t now) {
  if (schedule_.held() != held) {
    schedule_.Hold(held, clock_.GroupTime(now + kHoldMargin));
    next_beat_ = now;
  }
}

// The hour and departures are entries too.
void GroupMember::KeepLog(int64_t now) {
  schedule_.Settle(clock_.GroupTime(now));
  if (own_->minute != minute_ && own_->minute >= 0 && !schedule_.held()) {
    minute_ = own_->minute;
    log_.Append({.tick = NextTick(now),
                 .x = static_cast<int16_t>(minute_),
                 .kind = GroupEntry::Kind::kHour},
                "");
  }
  for (size_t who = 0; who < log_.devices().size(); ++who) {
    const GroupLog::Device& device = log_.devices()[who];
    const auto peer = peers_.find(device.name);
    const bool here = device.name == options_.name ||
                      (peer != peers_.end() && now - peer->second.heard < kLeaveAfter);
    if (device.present && !here && !schedule_.held()) {
      log_.Append({.tick = NextTick(now),
                   .who = static_cast<uint8_t>(who),
                   .kind = GroupEntry::Kind::kLeave},
                  "");
    }
  }
  const bool guided = std::any_of(peers_.begin(), peers_.end(), [this](const auto& one) {
    const GroupBeat& beat = one.second.beat;
    return IsAlive(one.second) && beat.guide && beat.ready && beat.run == schedule_.run &&
           beat.leader == options_.name && log_.Has(beat.log);
  });
  if (guided && !options_.guide) {
    leads_ = false;  // The guide's device, which has everything, takes over.
    leader_.clear();
    next_beat_ = now;
  }
}

// ---- what is sent

size_t GroupMember::SendPart(const std::string& to, size_t from) {
  const GroupLogPart part = {epoch_, schedule_.run, log_.PlaceAt(from), log_.Part(from)};
  Send(to, part, true);
  return part.part.entries.size();
}

void GroupMember::SendAsk(int64_t now) {
  if (asked_ == 0 || now - asked_ > kAskAgain) {
    asked_ = now;
    Send(leader_, GroupAsk{log_.Places()}, true);
  }
}

void GroupMember::SendBeat(int64_t now) {
  GroupBeat beat;
  beat.boot = options_.boot;
  beat.sent = now;
  beat.since = since_;
  beat.guide = options_.guide;
  beat.ready = ready_;
  beat.leads = leads_;
  beat.visited = own_->visited;
  beat.leader = leader_;
  beat.show = own_->show;
  beat.epoch = epoch_;
  beat.run = schedule_.run;
  beat.log = leads_ ? log_.PlaceAt(told_) : log_.place();
  beat.mark = marks_.empty() ? GroupMark() : marks_.back();
  bool all_ready = ready_;
  if (leads_) {
    beat.followers = static_cast<uint16_t>(Followers());
    beat.time = clock_.GroupTime(now);
    beat.pieces = schedule_.pieces;
    for (auto& [name, peer] : peers_) {
      all_ready = all_ready && (peer.beat.ready || !IsAlive(peer));
      if (peer.came != 0) {
        beat.echoes.push_back({name, peer.beat.sent, peer.came});
        peer.came = 0;
      }
    }
  }
  const int64_t more = std::max<int64_t>(1, static_cast<int64_t>(members() / kBeatMembers));
  next_beat_ = now + (all_ready ? kBeat * more : kQuickBeat);
  Send("", beat, false);
}

void GroupMember::Send(const std::string& to, const GroupMessage& message, bool reliable) {
  outgoing_.push_back({to, FormatGroupMessage(message), reliable});
}

}  // namespace lararium::group
