#include "player/staff/staff_state.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace lararium::player {
namespace {

constexpr size_t kMostLanguages = 32;
constexpr size_t kMostMarkers = 64;
constexpr int kSchema = 1;

double Share(int64_t part, int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

template <typename T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json FirstOf(const std::vector<std::string>& texts, size_t most) {
  const size_t count = std::min(texts.size(), most);
  return std::vector<std::string>(texts.begin(),
                                  texts.begin() + static_cast<std::ptrdiff_t>(count));
}

Json JsonOf(const std::vector<RecentWarnings::Entry>& warnings) {
  const auto now = std::chrono::steady_clock::now();
  Json list = Json::array();
  for (const RecentWarnings::Entry& entry : warnings) {
    list.push_back({{"text", entry.text},
                    {"error", entry.error},
                    {"times", entry.times},
                    {"seconds_ago", std::chrono::duration<double>(now - entry.time).count()}});
  }
  return list;
}

}  // namespace

void TrackingTally::Add(double now, bool tracked, bool people_went) {
  now_ = static_cast<int64_t>(std::floor(now));
  Second& second = seconds_[static_cast<size_t>(now_ % kSeconds)];
  if (second.second != now_) {
    second = {now_, 0, 0};
  }
  ++second.frames;
  second.tracked += tracked ? 1 : 0;
  ++frames_;
  tracked_ += tracked ? 1 : 0;
  losses_ += people_went && !gone_ ? 1 : 0;
  gone_ = people_went;
  ++rate_frames_;
  if (frames_ == 1 || now - rate_since_ >= kRateSeconds) {
    rate_ = frames_ == 1 ? 0.0 : static_cast<double>(rate_frames_) / (now - rate_since_);
    rate_since_ = now;
    rate_frames_ = 0;
  }
}

double TrackingTally::since_start() const { return Share(tracked_, frames_); }

double TrackingTally::last_minute() const {
  int64_t frames = 0;
  int64_t tracked = 0;
  for (const Second& second : seconds_) {
    if (second.second > now_ - kSeconds) {
      frames += second.frames;
      tracked += second.tracked;
    }
  }
  return Share(tracked, frames);
}

std::string StaffJson(const StaffState& state, const StaffMachine& machine) {
  const Json power = {{"celsius", OrNull(machine.celsius)},
                      {"battery", machine.battery ? Json(machine.battery->share) : Json()},
                      {"charging", machine.battery ? Json(machine.battery->charging) : Json()}};
  const Json tracking = {{"state", vision::Name(state.tracking)},
                         {"reason", vision::Name(state.reason)},
                         {"lost_seconds", state.lost_seconds},
                         {"confidence", state.confidence},
                         {"tracked", state.tracked},
                         {"tracked_minute", state.tracked_minute},
                         {"losses", state.losses}};
  const Json json = {
      {"version", LARARIUM_VERSION},
      {"title", state.title},
      {"show", state.show},
      {"place", state.place},
      {"position", OrNull(state.position)},
      {"seconds", state.seconds},
      {"length", OrNull(state.length)},
      {"kiosk", state.kiosk},
      {"visitor", OrNull(state.visitor)},
      {"tracking", tracking},
      {"picture", {{"frames_per_second", state.frames_per_second}, {"quality", state.quality}}},
      {"power", power},
      {"sound", {{"volume", state.choices.volume}, {"audible", state.audible}}},
      {"language", state.choices.language},
      {"languages", FirstOf(state.languages, kMostLanguages)},
      {"captions", state.choices.captions},
      {"caption_languages", FirstOf(state.caption_languages, kMostLanguages)},
      {"caption_size", NameOf(render::kCaptionSizes, state.choices.caption_style.size)},
      {"caption_contrast", NameOf(render::kCaptionContrasts, state.choices.caption_style.contrast)},
      {"descriptions", state.has_descriptions ? Json(state.choices.descriptions) : Json()},
      {"reduced_motion", state.choices.reduced_motion},
      {"held", OrNull(state.held)},
      {"markers", FirstOf(state.markers, kMostMarkers)},
      {"up_seconds", state.up_seconds},
      {"restarts", state.restarts},
      {"memory_mib", machine.memory_mib},
      {"warnings", JsonOf(machine.warnings)}};
  return DumpJson(json);
}

void LastState::Set(std::string_view player) {
  player_ = player;
  came_ = Clock::now();
}

std::string LastState::ToJson(Json more) const {
  more["schema"] = kSchema;
  more["answers"] = answers();
  more["silent_seconds"] = silent_seconds();
  // The player's own text is inserted unchanged.
  std::string text = DumpJson(more);
  text.pop_back();
  return text + ",\"player\":" + (player_.empty() ? "null" : player_) + "}";
}

}  // namespace lararium::player
