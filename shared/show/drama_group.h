#pragma once

// One drama that the shows of several devices play together (docs/internals/group.md). Another
// thread, which knows the group, says when the drama is where and what the visitors did; the show
// follows, and says what its own visitor does.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shared/drama/drama.h"

namespace lararium::show {

class GroupSeat;

class DramaGroup {
 public:
  // From a moment of the steady clock on, the drama is at `seconds` and goes on at a rate.
  struct Piece {
    double since = 0.0;    // Seconds of the steady clock.
    double seconds = 0.0;  // Time of the drama.
    double rate = 1.0;     // 0: the drama is held.

    friend bool operator==(const Piece&, const Piece&) = default;
  };
  struct Clock {
    uint64_t run = 0;  // Another run: the group went to another moment of the drama.
    Piece now;
    std::optional<Piece> next;  // Follows `now`.

    // Where the drama is to be at a time of the steady clock.
    double At(double steady) const;
    double RateAt(double steady) const;

    friend bool operator==(const Clock&, const Clock&) = default;
  };
  // A hash of the stage's state at a tick, which is the same on all devices.
  struct Mark {
    uint64_t run = 0;
    int64_t tick = 0;
    uint64_t hash = 0;
  };
  // What the visitor of this device does.
  struct Own {
    drama::Visitor visitor;  // Keys: since the last Take().
    bool restart = false;    // The visitor asked for the beginning.
    std::optional<Mark> mark;
  };

  // steady: seconds of a steady clock, the time of Clock and Piece.
  explicit DramaGroup(std::function<double()> steady) : steady_(std::move(steady)) {}
  DramaGroup(const DramaGroup&) = delete;
  DramaGroup& operator=(const DramaGroup&) = delete;

  double Now() const { return steady_(); }

  // ---- for the thread that knows the group ----

  // What the visitors did from a tick (at least 1) on.
  struct Revision {
    int64_t tick = 1;
    std::vector<drama::VisitorLog::Entry> entries;
  };
  void Update(const Clock& clock, const std::optional<Revision>& revision);
  // What the visitor does; nullopt: no show has said anything yet.
  std::optional<Own> TakeOwn();

 private:
  friend class GroupSeat;

  std::function<double()> steady_;
  std::mutex mutex_;
  std::optional<Clock> clock_;
  drama::VisitorLog log_;
  std::vector<GroupSeat*> seats_;
  std::optional<Own> own_;
};

// How one show takes part in a group. Used by one thread at a time. Borrows the group and the
// drama.
class GroupSeat {
 public:
  // Ticks between two states of which a hash is told.
  static constexpr int64_t kMarkTicks = drama::Drama::kTicksPerSecond;

  GroupSeat(DramaGroup& group, drama::Drama& drama);
  ~GroupSeat();
  GroupSeat(const GroupSeat&) = delete;
  GroupSeat& operator=(const GroupSeat&) = delete;

  // Tells the group of the visitor, and brings the drama up to date with what the group says. Call
  // it once for each frame; time: of the frame, seconds. Returns the time of the drama at which the
  // frame is to be staged. The drama may have gone back, or, if it was far behind, forth.
  double Next(const drama::Visitor& own, bool restart, double time);
  // The drama is not where the group is: it is being played to there in several frames.
  bool catching_up() const { return catching_up_; }
  uint64_t run() const { return run_; }  // DramaGroup::Clock::run of the last frame.
  // Plays the drama to where the group is, which may take seconds.
  Status CatchUp();

  // Notes the state at a tick that is a multiple of kMarkTicks.
  void NoteMark(int64_t tick, uint64_t hash);

 private:
  friend class DramaGroup;

  std::optional<DramaGroup::Clock> TakeNews();
  void Tell(const drama::Visitor& own, bool restart);
  double Follow(const DramaGroup::Clock& clock, double steady);
  double SteadyTimeOf(double time);

  DramaGroup& group_;
  drama::Drama& drama_;
  // Under DramaGroup::mutex_: the first tick that the drama was not told since it changed.
  int64_t revised_from_ = 1;
  std::optional<DramaGroup::Mark> marks_[3];  // Newest first.
  uint64_t run_ = 0;
  std::optional<double> seconds_;  // Time of the drama in the last frame.
  double last_steady_ = 0.0;
  double began_ = 0.0;           // Steady time of the first frame.
  std::optional<double> ahead_;  // Steady clock minus time of frames, without its jitter.
  bool catching_up_ = false;
};

}  // namespace lararium::show
