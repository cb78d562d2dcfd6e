#pragma once

// The state that the staff page and the page of a fleet show, and how it is collected from frames.

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "player/kiosk/kiosk_state.h"
#include "player/kiosk/power_sensors.h"
#include "player/kiosk/recent_warnings.h"
#include "shared/core/json.h"
#include "shared/show/show.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

// Statistics of tracking: share of tracked frames, and number of losses.
class TrackingTally {
 public:
  // Adds a frame. now: seconds of a steady clock. people_went: people have faded out, because there
  // was no pose for a while.
  void Add(double now, bool tracked, bool people_went);

  double since_start() const;  // share of tracked frames, 0 without frames
  double last_minute() const;
  int64_t losses() const { return losses_; }
  double frames_per_second() const { return rate_; }  // mean over the last seconds

 private:
  static constexpr int kSeconds = 60;
  static constexpr int kRateSeconds = 2;
  struct Second {
    int64_t second = -1;  // time `now`, rounded down
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

// The state at one moment. Durations are in seconds.
struct StaffState {
  std::string title;
  std::string show;  // Identity of the bundle (ShowMaker::version()).
  std::string place;
  // Position of the camera in metres, stage axes of the place; nullopt: unknown.
  std::optional<std::array<double, 3>> position;
  double seconds = 0.0;          // drama time
  std::optional<double> length;  // length of the story, if the author states it
  bool kiosk = false;
  std::optional<bool> visitor;  // a visitor is present; nullopt: unknown, because it is not a kiosk
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
  std::optional<bool> held;          // The staff holds the drama; nullopt: in a group.
  std::vector<std::string> markers;  // Moments of the drama to which the staff may go.
  double up_seconds = 0.0;           // time since the start of this run
  int restarts = 0;                  // number of restarts before it
};

// The state of the machine.
struct StaffMachine {
  std::optional<double> celsius;
  std::optional<Battery> battery;
  double memory_mib = 0.0;
  std::vector<RecentWarnings::Entry> warnings;
};

// Converts the state to JSON, the field `player` of a state (docs/file-formats.md). The text is
// valid UTF-8 and fits into a message.
std::string StaffJson(const StaffState& state, const StaffMachine& machine);

// What a process beside the player knows of it: the last state, and for how long it has been
// silent.
class LastState {
 public:
  // player: text that StaffJson() made.
  void Set(std::string_view player);
  // False: the player is starting, or hangs.
  bool answers() const { return !player_.empty() && silent_seconds() < kSilentSeconds; }
  // The state as it is published (docs/file-formats.md). more: fields that are added to it.
  std::string ToJson(Json more) const;

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kSilentSeconds = 3.0;

  double silent_seconds() const {
    return player_.empty() ? 0.0 : std::chrono::duration<double>(Clock::now() - came_).count();
  }

  std::string player_;
  Clock::time_point came_;
};

}  // namespace lararium::player
