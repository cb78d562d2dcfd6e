#include "player/kiosk/visit_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <system_error>
#include <utility>

#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::player {
namespace {

constexpr int64_t kSchema = 1;
constexpr uint64_t kMaxBytes = 4 << 20;
constexpr int64_t kMostCount = 1'000'000'000;
constexpr double kMostSeconds = 200'000.0;  // more than a day has, because clocks may be set back
// Longer intervals between frames count as this time, because nothing is known about the rest.
constexpr double kLongestFrame = 1.0;
// A larger step of the drama's time is a jump, not playing.
constexpr double kLongestStep = 2.0;

std::filesystem::path StatisticsFile(const std::filesystem::path& folder) {
  return folder / "statistics.json";
}

bool IsDay(std::string_view text) {
  int year = 0;
  int month = 0;
  int day = 0;
  char rest = 0;
  return text.size() == 10 &&
         std::sscanf(std::string(text).c_str(), "%4d-%2d-%2d%c", &year, &month, &day, &rest) == 3 &&
         month >= 1 && month <= 12 && day >= 1 && day <= 31;
}

// Seconds are written without a fraction.
void DescribeSeconds(Fields& fields, std::string_view name, double& value) {
  double seconds = std::round(std::min(value, kMostSeconds));
  fields.Number(name, seconds, 0.0, kMostSeconds);
  if (fields.reading()) {
    value = seconds;
  }
}

void DescribeDay(Fields& fields, DayCounts& day) {
  fields.Text("day", day.day, 10);
  fields.Require(IsDay(day.day), "\"day\" must be a date as 2026-11-23");
  fields.Integer("visitors", day.visitors, 0, kMostCount);
  fields.Integer("completed", day.completed, 0, kMostCount);
  fields.Integer("losses", day.losses, 0, kMostCount);
  fields.Integer("restarts", day.restarts, 0, kMostCount);
  DescribeSeconds(fields, "played_seconds", day.played_seconds);
  DescribeSeconds(fields, "seen_seconds", day.seen_seconds);
  DescribeSeconds(fields, "tracked_seconds", day.tracked_seconds);
  VisitDetails details = *day.details;
  DescribeFields(fields, details);
  if (fields.reading() && !details.empty()) {
    day.details = std::move(details);
  }
}

void DescribeDays(Fields& fields, std::vector<DayCounts>& days) {
  fields.Schema(kSchema, "was written by a newer player", "update this one");
  fields.List("days", days, VisitStatistics::kMostDays, DescribeDay);
}

// A day as others may know it.
DayCounts PublicDay(DayCounts day) {
  if (day.visitors < VisitDetails::kLeastTold) {
    return {.day = day.day, .visitors = day.visitors, .restarts = day.restarts};
  }
  VisitDetails details = *day.details;
  RemoveSmallCounts(details);
  day.details = std::move(details);
  return day;
}

void SetAside(const std::filesystem::path& path, const Status& why, Log& log) {
  const std::filesystem::path aside = path.string() + ".damaged";
  std::error_code error;
  std::filesystem::rename(path, aside, error);
  log.Warn("{}; the statistics start again from zero, the old file is {}", why.message(),
           error ? "lost" : aside.string());
}

}  // namespace

DayCounts& VisitStatistics::Day(const std::string& day) {
  // The day is nearly always the last one.
  if (!days_.empty() && days_.back().day == day) {
    return days_.back();
  }
  auto at =
      std::lower_bound(days_.begin(), days_.end(), day,
                       [](const DayCounts& d, const std::string& name) { return d.day < name; });
  if (at == days_.end() || at->day != day) {
    at = days_.insert(at, DayCounts{.day = day});
    const size_t index = static_cast<size_t>(at - days_.begin());
    for (size_t i = 0; i + kMostDetailedDays < days_.size(); ++i) {
      days_[i].details = {};
    }
    at = days_.begin() + static_cast<std::ptrdiff_t>(index);
  }
  if (days_.size() > kMostDays) {
    const bool is_oldest = at == days_.begin();
    const auto oldest = is_oldest ? days_.begin() + 1 : days_.begin();
    const size_t index = static_cast<size_t>(at - days_.begin()) - (is_oldest ? 0 : 1);
    days_.erase(oldest);
    return days_[index];
  }
  return *at;
}

std::string VisitStatistics::ToCsv() const {
  std::string text =
      "day,visitors,minutes_played,seen_to_the_end,share_tracked,losses,restarts\r\n";
  for (const DayCounts& day : days_) {
    char line[160];
    char share[16] = "";
    if (day.seen_seconds > 0.0) {
      std::snprintf(share, sizeof(share), "%.3f",
                    std::min(day.tracked_seconds / day.seen_seconds, 1.0));
    }
    std::snprintf(line, sizeof(line), "%s,%lld,%.1f,%lld,%s,%lld,%lld\r\n", day.day.c_str(),
                  static_cast<long long>(day.visitors), day.played_seconds / 60.0,
                  static_cast<long long>(day.completed), share, static_cast<long long>(day.losses),
                  static_cast<long long>(day.restarts));
    text += line;
  }
  return text;
}

std::string Today() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  char text[32];
  return {text, std::strftime(text, sizeof(text), "%Y-%m-%d", &local)};
}

VisitStatistics LoadVisitStatistics(const std::filesystem::path& folder, Log& log) {
  const std::filesystem::path path = StatisticsFile(folder);
  if (!FileExists(path)) {
    return {};
  }
  const Result<std::string> text = ReadText(path, kMaxBytes);
  Result<VisitStatistics> statistics =
      text.ok() ? ParseVisitStatistics(*text, path.string()) : text.status();
  if (statistics.ok()) {
    return *std::move(statistics);
  }
  SetAside(path, statistics.status(), log);
  return {};
}

Result<VisitStatistics> ParseVisitStatistics(std::string_view text, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(
      const std::vector<DayCounts> days,
      ParseFields<std::vector<DayCounts>>(text, where, DescribeDays, UnknownFields::kIgnore));
  VisitStatistics statistics;
  for (const DayCounts& day : days) {
    statistics.Day(day.day) = day;
  }
  return statistics;
}

std::string PublishedStatistics(const VisitStatistics& statistics) {
  const std::vector<DayCounts>& all = statistics.days();
  std::vector<DayCounts> days;
  for (size_t i = all.size() - std::min(all.size(), kMostPublishedDays); i < all.size(); ++i) {
    days.push_back(PublicDay(all[i]));
  }
  std::string text = DumpJson(FormatFields(days, DescribeDays));
  while (text.size() > kMostPublishedBytes) {
    days.erase(days.begin());
    text = DumpJson(FormatFields(days, DescribeDays));
  }
  return text;
}

Status SaveVisitStatistics(const std::filesystem::path& folder, const VisitStatistics& statistics) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return Status::Error(folder.string(), "cannot be created: " + error.message(),
                         "name another folder with --state");
  }
  return SaveJson(StatisticsFile(folder), FormatFields(statistics.days(), DescribeDays));
}

void VisitCounter::BeginVisit(const Moment& moment, DayCounts& day) {
  is_whole_ = !std::exchange(counted_before_, false);
  day.visitors += is_whole_ ? 1 : 0;
  began_ = moment.last_sign;
  counted_until_ = moment.last_sign;
  pending_ = {};
  located_ = false;
  visit_ = {.drama_seconds = moment.drama_time,
            .language = std::string(moment.language),
            .captions = std::string(moment.captions)};
}

// Notes where the camera was when tracking was lost.
void VisitCounter::NoteCell(const Moment& moment) {
  const auto metre = [](double value) {
    constexpr double kFarthest = VisitDetails::kFarthest;
    return static_cast<int>(std::clamp(std::floor(value), -kFarthest, kFarthest));
  };
  if (visit_.lost.size() + pending_.lost.size() < VisitDetails::kMostCells && located_) {
    pending_.lost.push_back({std::string(moment.place), metre(last_at_[0]), metre(last_at_[1])});
  }
}

void VisitCounter::Count(const Moment& moment, DayCounts& day) {
  const double frame = std::clamp(moment.now - last_now_, 0.0, kLongestFrame);
  const double step = moment.drama_time - last_drama_time_;
  if (moment.noticed && !there_) {
    BeginVisit(moment, day);
  }
  if (moment.noticed) {
    pending_.seen_seconds += there_ ? frame : 0.0;
    pending_.tracked_seconds += there_ && moment.tracked ? frame : 0.0;
    if (moment.people_went && !gone_) {
      ++pending_.losses;
      NoteCell(moment);
    }
    const bool ended = moment.story_length > 0.0 && step > 0.0 && step < kLongestStep &&
                       last_drama_time_ < moment.story_length &&
                       moment.drama_time >= moment.story_length;
    day.completed += ended ? 1 : 0;
  }
  if (moment.noticed && moment.last_sign > counted_until_) {
    day.played_seconds += moment.last_sign - std::exchange(counted_until_, moment.last_sign);
    day.seen_seconds += pending_.seen_seconds;
    day.tracked_seconds += pending_.tracked_seconds;
    day.losses += pending_.losses;
    for (FloorCell& cell : pending_.lost) {
      if (std::find(visit_.lost.begin(), visit_.lost.end(), cell) == visit_.lost.end()) {
        visit_.lost.push_back(std::move(cell));
      }
    }
    pending_ = {};
    visit_.seconds = counted_until_ - began_;
    visit_.drama_seconds = moment.drama_time;
    visit_.language = moment.language;
    visit_.captions = moment.captions;
  }
  if (there_ && !moment.noticed && is_whole_) {
    VisitDetails details = *day.details;
    AddVisit(visit_, details);
    day.details = std::move(details);
  }
  if (moment.tracked) {
    located_ = moment.noticed;
    last_at_ = moment.at;
  }
  there_ = moment.noticed;
  gone_ = moment.people_went;
  last_now_ = moment.now;
  last_drama_time_ = moment.drama_time;
}

}  // namespace lararium::player
