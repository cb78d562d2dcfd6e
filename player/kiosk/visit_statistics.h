#pragma once

// Statistics of a kiosk for each day: counts and sums, without images, persons or times of day.
// What leaves the device has no small counts (PublishedStatistics()). VisitCounter collects them
// while a show runs.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "player/kiosk/visit_details.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

struct DayCounts {
  std::string day;              // local date, for example "2026-11-23"
  int64_t visitors = 0;         // people who took the headset
  double played_seconds = 0.0;  // time between taking the headset and its last motion
  int64_t completed = 0;        // stories that were seen to their end
  double seen_seconds = 0.0;    // the part of played_seconds in which images arrived
  double tracked_seconds = 0.0;
  int64_t losses = 0;    // losses of tracking that were long enough for people to fade out
  int64_t restarts = 0;  // restarts by the watchdog
  SharedDetails details = {};

  friend bool operator==(const DayCounts&, const DayCounts&) = default;
};

class VisitStatistics {
 public:
  static constexpr size_t kMostDays = 400;
  static constexpr size_t kMostDetailedDays = 92;

  // The counts of a day, to add to them. If there are more than kMostDays, the oldest is removed;
  // days before the last kMostDetailedDays lose their details.
  DayCounts& Day(const std::string& day);
  // The days in ascending order.
  const std::vector<DayCounts>& days() const { return days_; }

  // A header line, then one line for each day (RFC 4180).
  std::string ToCsv() const;

  friend bool operator==(const VisitStatistics&, const VisitStatistics&) = default;

 private:
  std::vector<DayCounts> days_;
};

// The local date, for example "2026-11-23".
std::string Today();

// folder: the kiosk's folder. Without a file, the statistics are empty. A file that cannot be read
// is renamed to "statistics.json.damaged", and the log says so; the statistics are then empty.
VisitStatistics LoadVisitStatistics(const std::filesystem::path& folder, Log& log);
// where: name of the text in errors.
Result<VisitStatistics> ParseVisitStatistics(std::string_view text, const std::string& where);
// Writes atomically: after a failure the old file is still complete.
Status SaveVisitStatistics(const std::filesystem::path& folder, const VisitStatistics& statistics);

// The text that a device of a fleet publishes (docs/file-formats.md): the last kMostPublishedDays
// without small counts. Of a day with fewer than VisitDetails::kLeastTold visitors it has only
// their number and the restarts. Days that do not fit into kMostPublishedBytes are left out, the
// oldest first.
inline constexpr size_t kMostPublishedDays = 31;
inline constexpr size_t kMostPublishedBytes = 60'000;
std::string PublishedStatistics(const VisitStatistics& statistics);

// Updates the counts, frame by frame.
class VisitCounter {
 public:
  struct Moment {
    double now = 0.0;        // seconds of a steady clock
    bool noticed = false;    // VisitorWatch::noticed()
    double last_sign = 0.0;  // VisitorWatch::last_sign()
    bool tracked = false;
    bool people_went = false;   // people have faded out, because tracking was lost
    double drama_time = 0.0;    // seconds
    double story_length = 0.0;  // seconds; 0: unknown
    std::string_view place = {};
    std::array<double, 2> at = {};   // x and z of the camera on the place's stage; valid if tracked
    std::string_view language = {};  // The spoken language; "": none.
    std::string_view captions = {};
  };

  // resumed: the first visitor was present before a restart and is counted already.
  explicit VisitCounter(bool resumed = false) : counted_before_(resumed) {}

  // Adds a frame to the counts of a day. Time after the last motion of a visitor is not counted,
  // because the headset was not used then.
  void Count(const Moment& moment, DayCounts& day);

 private:
  // Counts since the last sign of the visitor. They are added to the day with the next sign.
  struct Pending {
    double seen_seconds = 0.0;
    double tracked_seconds = 0.0;
    int64_t losses = 0;
    std::vector<FloorCell> lost;
  };

  void BeginVisit(const Moment& moment, DayCounts& day);
  void NoteCell(const Moment& moment);

  bool counted_before_;
  bool there_ = false;
  bool gone_ = false;
  double counted_until_ = 0.0;  // Moment::last_sign of the last addition
  double last_now_ = 0.0;
  double last_drama_time_ = 0.0;
  Pending pending_;
  // The visit that goes on. Its details are added to the day when it is over.
  VisitSummary visit_;
  double began_ = 0.0;
  bool is_whole_ = false;  // The beginning of the visit was seen.
  bool located_ = false;   // The camera was tracked in this visit.
  std::array<double, 2> last_at_ = {};
};

}  // namespace lararium::player
