#include "shared/show/drama_group.h"

#include <algorithm>
#include <cmath>

namespace lararium::show {
namespace {

constexpr double kMostSlew = 0.05;    // The drama is at most this much faster or slower.
constexpr double kSlewSeconds = 1.0;  // A small difference disappears in this time.
constexpr double kJumpSeconds = 0.5;  // Seconds; larger differences are jumped over.
constexpr double kFarBehind = 2.0;    // Seconds; more are played in several frames.
constexpr double kCatchUpStep = 1.0;  // Seconds of the drama that are played at once.
constexpr double kFrameShare = 0.03;  // Seconds of a frame in which the drama is played.
constexpr double kPatience = 5.0;     // The drama begins after this time without any news.
constexpr double kJitterShare = 0.02;
constexpr double kClockStep = 0.25;  // Seconds; a larger change of the frames' clock is a step.
constexpr int64_t kMarkAge = int64_t{2} * drama::Drama::kTicksPerSecond;  // Late news come earlier.

int64_t TickOf(double seconds) { return std::llround(seconds * drama::Drama::kTicksPerSecond); }

}  // namespace

double DramaGroup::Clock::At(double steady) const {
  const Piece& piece = next && steady >= next->since ? *next : now;
  const double seconds = piece.seconds + piece.rate * (steady - piece.since);
  return std::clamp(seconds, 0.0, drama::Drama::kMaxTime);
}

double DramaGroup::Clock::RateAt(double steady) const {
  return next && steady >= next->since ? next->rate : now.rate;
}

void DramaGroup::Update(const Clock& clock, const std::optional<Revision>& revision) {
  const std::lock_guard lock(mutex_);
  clock_ = clock;
  if (!revision) {
    return;
  }
  log_.Truncate(revision->tick - 1);
  for (const drama::VisitorLog::Entry& entry : revision->entries) {
    log_.Set(entry.tick, entry.visitor);
  }
  for (GroupSeat* seat : seats_) {
    seat->revised_from_ = std::min(seat->revised_from_, revision->tick);
  }
}

std::optional<DramaGroup::Own> DramaGroup::TakeOwn() {
  const std::lock_guard lock(mutex_);
  std::optional<Own> own = own_;
  if (own_) {
    own_->visitor.keys.clear();
    own_->restart = false;
  }
  return own;
}

GroupSeat::GroupSeat(DramaGroup& group, drama::Drama& drama) : group_(group), drama_(drama) {
  drama_.SetVisitorLog({});
  const std::lock_guard lock(group_.mutex_);
  group_.seats_.push_back(this);
}

GroupSeat::~GroupSeat() {
  const std::lock_guard lock(group_.mutex_);
  std::erase(group_.seats_, this);
}

void GroupSeat::Tell(const drama::Visitor& own, bool restart) {
  const std::lock_guard lock(group_.mutex_);
  DramaGroup::Own& told = group_.own_ ? *group_.own_ : group_.own_.emplace(DramaGroup::Own{});
  std::string keys = std::move(told.visitor.keys);
  std::string_view more = own.keys;
  for (std::string_view key = drama::TakeKey(more); !key.empty(); key = drama::TakeKey(more)) {
    drama::AddKey(key, keys);
  }
  const glm::vec3 position = told.visitor.position;
  const glm::vec3 direction = told.visitor.direction;
  told.visitor = own;
  if (!own.tracked) {
    told.visitor.position = position;
    told.visitor.direction = direction;
  }
  told.visitor.keys = std::move(keys);
  told.restart = told.restart || restart;
  for (const std::optional<DramaGroup::Mark>& mark : marks_) {
    if (mark && mark->tick + kMarkAge <= TickOf(drama_.time())) {
      told.mark = mark;
      break;
    }
  }
}

// What has changed since the last frame is brought into the drama.
std::optional<DramaGroup::Clock> GroupSeat::TakeNews() {
  const std::lock_guard lock(group_.mutex_);
  constexpr int64_t kNever = std::numeric_limits<int64_t>::max();
  const int64_t from = std::exchange(revised_from_, kNever);
  if (from == kNever) {
    return group_.clock_;
  }
  const std::span<const drama::VisitorLog::Entry> all = group_.log_.entries();
  const auto first = std::lower_bound(
      all.begin(), all.end(), from,
      [](const drama::VisitorLog::Entry& entry, int64_t tick) { return entry.tick < tick; });
  if (first != all.end() || !drama_.visitor_log().entries().empty()) {
    (void)drama_.ReviseVisitorLog(from, {first, all.end()}).ok();  // The drama logs its errors.
  }
  for (std::optional<DramaGroup::Mark>& mark : marks_) {
    if (mark && mark->tick >= from) {
      mark.reset();
    }
  }
  return group_.clock_;
}

void GroupSeat::NoteMark(int64_t tick, uint64_t hash) {
  if (marks_[0] && marks_[0]->run == run_ && marks_[0]->tick >= tick) {
    return;
  }
  marks_[2] = marks_[1];
  marks_[1] = marks_[0];
  marks_[0] = {run_, tick, hash};
}

// The frames' own clock is steadier than the moments at which they arrive here.
double GroupSeat::SteadyTimeOf(double time) {
  const double ahead = group_.Now() - time;
  if (!ahead_ || std::abs(ahead - *ahead_) > kClockStep) {
    ahead_ = ahead;
  }
  *ahead_ += kJitterShare * (ahead - *ahead_);
  return time + *ahead_;
}

// The drama's time goes towards the group's, and never back unless the group or this device jumps.
double GroupSeat::Follow(const DramaGroup::Clock& clock, double steady) {
  const double wanted = clock.At(steady);
  const double off = wanted - seconds_.value_or(0.0);
  if (!seconds_ || clock.run != run_ || std::abs(off) > kJumpSeconds) {
    run_ = clock.run;
    return wanted;
  }
  const double rate = clock.RateAt(steady) + std::clamp(off / kSlewSeconds, -kMostSlew, kMostSlew);
  const double passed = std::max(steady - last_steady_, 0.0);
  return *seconds_ + passed * std::max(rate, 0.0);
}

double GroupSeat::Next(const drama::Visitor& own, bool restart, double time) {
  const double steady = SteadyTimeOf(time);
  if (began_ == 0.0) {
    began_ = last_steady_ = steady;
  }
  Tell(own, restart);
  std::optional<DramaGroup::Clock> clock = TakeNews();
  if (!clock && steady - began_ > kPatience) {
    clock = DramaGroup::Clock{0, {began_ + kPatience, 0.0, 1.0}, std::nullopt};
  }
  if (!clock) {
    catching_up_ = true;
    return 0.0;
  }
  const double wanted = Follow(*clock, steady);
  last_steady_ = steady;
  const double begin = group_.Now();
  catching_up_ = wanted - drama_.time() > kFarBehind;
  while (wanted - drama_.time() > kFarBehind && group_.Now() - begin < kFrameShare) {
    if (!drama_.Seek(std::min(drama_.time() + kCatchUpStep, wanted - 0.5 * kFarBehind)).ok()) {
      break;
    }
  }
  if (wanted - drama_.time() > kFarBehind) {
    seconds_.reset();  // The next frame jumps as well.
    return drama_.time();
  }
  seconds_ = wanted;
  return wanted;
}

Status GroupSeat::CatchUp() {
  const std::optional<DramaGroup::Clock> clock = TakeNews();
  return clock ? drama_.Seek(clock->At(group_.Now())) : Status();
}

}  // namespace lararium::show
