#pragma once

// What the staff page shows of a show, and how it is gathered from frames.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "player/kiosk_state.h"
#include "player/power_sensors.h"
#include "player/recent_warnings.h"
#include "shared/core/json.h"
#include "shared/show/show.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

// How well tracking goes: shares of frames, and losses.
class TrackingTally {
 public:
  // now: seconds of a steady clock. people_went: so long without a pose that people are gone.
  void Add(double now, bool tracked, bool people_went);

  double since_start() const;  // 0 without frames
  double last_minute() const;
  int64_t losses() const { return losses_; }
  double frames_per_second() const { return rate_; }  // of the last seconds

 private:
  static constexpr int kSeconds = 60;
  static constexpr int kRateSeconds = 2;
  struct Second {
    int64_t second = -1;  // of now
    int32_t frames = 0;
    int32_t tracked = 0;
  };

  std::array<Second, kSeconds> seconds_ = {};
  int64_t frames_ = 0;
  int64_t tracked_ = 0;
  int64_t losses_ = 0;
  bool gone_ = false;
  int64_t now_ = 0;
  double rate_ = 0.0;
  double rate_since_ = 0.0;
  int64_t rate_frames_ = 0;
};

// At a moment. Durations in seconds.
struct StaffState {
  std::string title;
  std::string place;
  double seconds = 0.0;          // of the drama
  std::optional<double> length;  // of its story, as far as its author says
  bool kiosk = false;
  std::optional<bool> visitor;  // whether somebody is there; none: nobody looks
  vision::TrackState tracking = vision::TrackState::kSearching;
  vision::TrackReason reason = vision::TrackReason::kNone;
  double lost_seconds = 0.0;
  double confidence = 0.0;
  double tracked = 0.0;
  double tracked_minute = 0.0;
  int64_t losses = 0;
  double frames_per_second = 0.0;
  size_t quality = 0;
  Choices choices;
  bool audible = false;
  std::vector<std::string> languages;
  std::vector<std::string> caption_languages;
  bool has_descriptions = false;
  double up_seconds = 0.0;  // of this run
  int restarts = 0;         // before it
};

// What is read of the machine besides.
struct StaffMachine {
  std::optional<double> celsius;
  std::optional<Battery> battery;
  double memory_mib = 0.0;
  std::vector<RecentWarnings::Entry> warnings;
};

// What staff_page/page.js shows. It is valid UTF-8 and at most as long as a message.
std::string StaffJson(const StaffState& state, const StaffMachine& machine);

}  // namespace lararium::player
