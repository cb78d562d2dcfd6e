#pragma once

// Relates the steady clock of a device to the time of its group, from times that it exchanges with
// the group's leader, as NTP does (Mills, RFC 5905). All times are microseconds.

#include <cstdint>
#include <deque>

namespace lararium::group {

class GroupClock {
 public:
  // A message went to the leader and another came back.
  struct Exchange {
    int64_t sent = 0;            // Own clock.
    int64_t group_received = 0;  // The group's time.
    int64_t group_sent = 0;      // The group's time.
    int64_t received = 0;        // Own clock.
  };

  // The group's time is known from this moment on.
  void Begin(int64_t own, int64_t group);
  // Exchanges that cannot be true are ignored. If the group's time has become another one, such as
  // that of a group to which this device returns, all earlier exchanges are forgotten.
  void Add(const Exchange& exchange);
  // Forgets the exchanges, not the time: for a device that becomes the leader, whose clock is then
  // the group's.
  void Lead(int64_t own);

  bool known() const { return known_; }
  // Number of exchanges since the group's time became another one.
  int exchanges() const { return exchanges_; }
  int64_t GroupTime(int64_t own) const;
  int64_t OwnTime(int64_t group) const;
  // How much faster the group's clock runs than the own one.
  double drift() const { return drift_; }
  // The shortest time of late that a message and its answer have taken.
  int64_t delay() const { return delay_; }

 private:
  struct Sample {
    int64_t own = 0;     // The own clock when the sample was taken.
    int64_t offset = 0;  // The group's time minus the own clock.
    int64_t delay = 0;
  };
  // The exchange with the shortest delay of some seconds: the others waited in queues.
  struct Bucket {
    int64_t number = 0;
    Sample best;
  };

  void Fit(int64_t own);

  bool known_ = false;
  int exchanges_ = 0;
  std::deque<Bucket> buckets_;
  // GroupTime(own) = own + offset_ + drift_ * (own - reference_).
  int64_t reference_ = 0;
  int64_t offset_ = 0;
  double drift_ = 0.0;
  int64_t delay_ = 0;
  int64_t last_sent_ = INT64_MIN;
};

}  // namespace lararium::group
