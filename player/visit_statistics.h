#pragma once

// What a kiosk's days were like: counts and sums, no images, no persons, no times of day. And how
// they are counted while a show runs.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

struct DayCounts {
  std::string day;              // of the machine's clock, as "2026-11-23"
  int64_t visitors = 0;         // who took the headset up
  double played_seconds = 0.0;  // from then until they last moved
  int64_t completed = 0;        // stories that were seen to their end
  double seen_seconds = 0.0;    // of played_seconds, those in which images came
  double tracked_seconds = 0.0;
  int64_t losses = 0;    // of tracking, long enough for people to go
  int64_t restarts = 0;  // by the watchdog

  friend bool operator==(const DayCounts&, const DayCounts&) = default;
};

class VisitStatistics {
 public:
  static constexpr size_t kMostDays = 400;

  // The counts of a day, for adding to them; the oldest day goes where there are too many.
  DayCounts& Day(const std::string& day);
  // Ascending.
  const std::vector<DayCounts>& days() const { return days_; }

  // A line of names, then one for each day; RFC 4180.
  std::string ToCsv() const;

  friend bool operator==(const VisitStatistics&, const VisitStatistics&) = default;

 private:
  std::vector<DayCounts> days_;
};

// The day of the machine's clock.
std::string Today();

// folder: the kiosk's. Without a file there are no days. One that cannot be read is set aside
// as "statistics.json.damaged", and the log says so: the days before are then not counted.
VisitStatistics LoadVisitStatistics(const std::filesystem::path& folder, Log& log);
// place: what errors call the text.
Result<VisitStatistics> ParseVisitStatistics(std::string_view text, const std::string& place);
// As a whole or not at all.
Status SaveVisitStatistics(const std::filesystem::path& folder, const VisitStatistics& statistics);

// Counts, frame by frame.
class VisitCounter {
 public:
  struct Moment {
    double now = 0.0;        // seconds of a steady clock
    bool noticed = false;    // VisitorWatch: somebody is there
    double last_sign = 0.0;  // likewise, when they last moved
    bool tracked = false;
    bool people_went = false;   // since tracking was lost
    double drama_time = 0.0;    // seconds
    double story_length = 0.0;  // seconds; 0: not known
  };

  // resumed: the first visitor was there before a restart and is counted already.
  explicit VisitCounter(bool resumed = false) : counted_before_(resumed) {}

  // What somebody does not move after is not counted: the headset lay there.
  void Count(const Moment& moment, DayCounts& day);

 private:
  // Since the last sign of the visitor.
  struct Pending {
    double seen_seconds = 0.0;
    double tracked_seconds = 0.0;
    int64_t losses = 0;
  };

  bool counted_before_;
  bool there_ = false;
  bool gone_ = false;
  double counted_until_ = 0.0;  // last_sign
  double last_now_ = 0.0;
  double last_drama_time_ = 0.0;
  Pending pending_;
};

}  // namespace lararium::player
