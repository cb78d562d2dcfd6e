#include "player/benchmark/benchmark_report.h"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

namespace lararium::player {
namespace {

Json ToJson(const Summary& summary) {
  if (summary.count == 0) {
    return Json();
  }
  return {{"count", summary.count},
          {"mean", summary.mean},
          {"median", summary.median},
          {"p95", summary.p95},
          {"max", summary.max}};
}

template <typename T>
Json ToJson(const std::optional<T>& value) {
  if (!value) {
    return Json();
  }
  if constexpr (std::is_same_v<T, Summary>) {
    return ToJson(*value);
  } else {
    return Json(*value);
  }
}

Json ToJson(const SequenceReport& report) {
  const SequenceScore& score = report.score;
  Json recoveries = Json::array();
  for (const Recovery& recovery : score.recoveries) {
    recoveries.push_back({{"first_visible", recovery.first_visible},
                          {"frames", recovery.frames},
                          {"found", recovery.found}});
  }
  Json errors = Json::array();
  for (const FrameError& error : score.errors) {
    errors.push_back({{"frame", error.frame},
                      {"registration_px", error.registration_px},
                      {"points", error.points},
                      {"centre", error.centre},
                      {"rotation_deg", error.rotation_deg},
                      {"normalised_pose_error", ToJson(error.normalised_pose_error)}});
  }
  return {{"name", report.name},
          {"frames", score.frames},
          {"tracked", score.tracked},
          {"visible", score.visible},
          {"visible_tracked", score.visible_tracked},
          {"followed", score.followed},
          {"longest_loss", score.longest_loss},
          {"false_accepts", score.false_accepts},
          {"blind_poses", score.blind_poses},
          {"recoveries", recoveries},
          {"registration_px", ToJson(score.registration_px)},
          {"centre_error", ToJson(score.centre)},
          {"rotation_error_deg", ToJson(score.rotation_deg)},
          {"calibration_frames", score.calibration.count()},
          {"calibration_error", score.calibration.Error()},
          {"normalised_pose_error", ToJson(score.normalised_pose_error)},
          {"swimming_px", score.swimming_px},
          {"jitter_px", ToJson(score.jitter_px)},
          {"lag_ms", ToJson(score.lag_ms)},
          {"gain_error_stops", ToJson(score.gain_error_stops)},
          {"followed_wall_ms", ToJson(score.followed_wall_ms)},
          {"followed_cpu_ms", ToJson(score.followed_cpu_ms)},
          {"found_wall_ms", ToJson(score.found_wall_ms)},
          {"found_cpu_ms", ToJson(score.found_cpu_ms)},
          {"missed_wall_ms", ToJson(score.missed_wall_ms)},
          {"missed_cpu_ms", ToJson(score.missed_cpu_ms)},
          {"per_frame", errors}};
}

Json ToJson(const ForeignReport& report) {
  return {{"name", report.name},
          {"frames", report.frames},
          {"accepted", report.accepted},
          {"cuts", report.cuts},
          {"accepted_after_cut", report.accepted_after_cut},
          {"back_after_cut", report.back_after_cut}};
}

// Totals over all sequences; every frame has the same weight.
struct Totals {
  size_t false_accepts = 0;
  Calibration calibration;
  Summary normalised_pose_error;
};

Totals TotalsOf(const BenchmarkReport& report) {
  Totals totals;
  std::vector<double> normalised;
  for (const SequenceReport& sequence : report.sequences) {
    totals.false_accepts += sequence.score.false_accepts;
    totals.calibration.Add(sequence.score.calibration);
    for (const FrameError& error : sequence.score.errors) {
      if (error.normalised_pose_error) {
        normalised.push_back(*error.normalised_pose_error);
      }
    }
  }
  for (const ForeignReport& foreign : report.foreign) {
    totals.false_accepts += foreign.accepted.size() + foreign.accepted_after_cut.size();
  }
  totals.normalised_pose_error = Summarise(std::move(normalised));
  return totals;
}

// ------------------------------------------------------------ the table

constexpr int kNameWidth = 14;

void PrintHeading(std::FILE* out, const char* title, const char* columns) {
  std::fprintf(out, "\n%-*s  %s\n", kNameWidth, title, columns);
}

// The slowest recovery; "-" if the lens was never covered.
std::string Back(const SequenceScore& score) {
  size_t slowest = 0;
  for (const Recovery& recovery : score.recoveries) {
    if (!recovery.found) {
      return "never";
    }
    slowest = std::max(slowest, recovery.frames);
  }
  return slowest == 0 ? "-" : std::to_string(slowest);
}

std::string Fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::string Fixed(const std::optional<double>& value, int digits) {
  return value ? Fixed(*value, digits) : "-";
}

std::string Pair(const Summary& summary) {
  return summary.count == 0 ? "-" : Fixed(summary.median, 1) + " / " + Fixed(summary.p95, 1);
}

void PrintTracking(const BenchmarkReport& report, std::FILE* out) {
  PrintHeading(out, "Tracking",
               "  frames tracked  of visible  followed  longest loss  back after  false  blind");
  for (const SequenceReport& sequence : report.sequences) {
    const SequenceScore& s = sequence.score;
    const std::string visible = std::to_string(s.visible_tracked) + "/" + std::to_string(s.visible);
    const double followed =
        s.tracked == 0 ? 0.0
                       : 100.0 * static_cast<double>(s.followed) / static_cast<double>(s.tracked);
    std::fprintf(out, "%-*s  %8zu %7zu  %10s  %6.1f %%  %12zu  %10s  %5zu  %5zu\n", kNameWidth,
                 sequence.name.c_str(), s.frames, s.tracked, visible.c_str(), followed,
                 s.longest_loss, Back(s).c_str(), s.false_accepts, s.blind_poses);
  }
}

void PrintAccuracy(const BenchmarkReport& report, std::FILE* out) {
  PrintHeading(out, "Registration px",
               "   mean  median     p95     max  swimming   jitter  lag ms  centre mm*  rot deg");
  for (const SequenceReport& sequence : report.sequences) {
    const SequenceScore& s = sequence.score;
    const bool compared = s.registration_px.count > 0;
    const auto figure = [&](double value, int digits) {
      return compared ? Fixed(value, digits) : "-";
    };
    const Summary& px = s.registration_px;
    std::fprintf(out, "%-*s  %7s %7s %7s %7s  %8s %8s %7s  %10s  %7s\n", kNameWidth,
                 sequence.name.c_str(), figure(px.mean, 4).c_str(), figure(px.median, 4).c_str(),
                 figure(px.p95, 4).c_str(), figure(px.max, 2).c_str(),
                 figure(s.swimming_px, 4).c_str(), Fixed(s.jitter_px, 4).c_str(),
                 Fixed(s.lag_ms, 2).c_str(), figure(1e3 * s.centre.mean, 3).c_str(),
                 figure(s.rotation_deg.mean, 4).c_str());
  }
  std::fprintf(out, "* thousandths of the ground truth's unit\n");
}

void PrintTrust(const BenchmarkReport& report, std::FILE* out) {
  PrintHeading(out, "Trust",
               "calibration error  pose error / covariance, mean  median  gain error stops");
  const auto line = [&](const std::string& name, const Calibration& calibration,
                        const Summary& normalised, const std::optional<Summary>& gain) {
    const bool has = normalised.count > 0;
    std::fprintf(out, "%-*s  %17.4f  %29s  %6s  %16s\n", kNameWidth, name.c_str(),
                 calibration.Error(), has ? Fixed(normalised.mean, 3).c_str() : "-",
                 has ? Fixed(normalised.median, 3).c_str() : "-",
                 gain ? (Fixed(gain->mean, 3) + " / " + Fixed(gain->p95, 3)).c_str() : "-");
  };
  for (const SequenceReport& sequence : report.sequences) {
    const SequenceScore& s = sequence.score;
    line(sequence.name, s.calibration, s.normalised_pose_error, s.gain_error_stops);
  }
  const Totals totals = TotalsOf(report);
  line("all", totals.calibration, totals.normalised_pose_error, std::nullopt);
}

void PrintTimes(const BenchmarkReport& report, std::FILE* out) {
  PrintHeading(out, "ms p50 / p95",
               "followed wall   followed cpu     found wall      found cpu     missed cpu");
  for (const SequenceReport& sequence : report.sequences) {
    const SequenceScore& s = sequence.score;
    std::fprintf(out, "%-*s  %13s  %13s  %13s  %13s  %13s\n", kNameWidth, sequence.name.c_str(),
                 Pair(s.followed_wall_ms).c_str(), Pair(s.followed_cpu_ms).c_str(),
                 Pair(s.found_wall_ms).c_str(), Pair(s.found_cpu_ms).c_str(),
                 Pair(s.missed_cpu_ms).c_str());
  }
}

void PrintForeign(const BenchmarkReport& report, std::FILE* out) {
  if (report.foreign.empty()) {
    return;
  }
  PrintHeading(out, "Other places", "images  accepted  after a cut  back at once");
  for (const ForeignReport& foreign : report.foreign) {
    const std::string back =
        std::to_string(foreign.back_after_cut) + "/" + std::to_string(foreign.cuts);
    std::fprintf(out, "%-*s  %6zu  %8zu  %11zu  %12s\n", kNameWidth, foreign.name.c_str(),
                 foreign.frames, foreign.accepted.size(), foreign.accepted_after_cut.size(),
                 back.c_str());
  }
}

}  // namespace

Json BenchmarkReport::ToJson() const {
  const Totals totals = TotalsOf(*this);
  Json json = {{"show", show},
               {"mode", mode},
               {"smoothing", smoothing},
               {"threads", threads},
               {"sequences", Json::array()},
               {"foreign", Json::array()},
               {"all",
                {{"false_accepts", totals.false_accepts},
                 {"calibration_error", totals.calibration.Error()},
                 {"normalised_pose_error", player::ToJson(totals.normalised_pose_error)}}}};
  for (const SequenceReport& sequence : sequences) {
    json["sequences"].push_back(player::ToJson(sequence));
  }
  for (const ForeignReport& report : foreign) {
    json["foreign"].push_back(player::ToJson(report));
  }
  return json;
}

void PrintBenchmark(const BenchmarkReport& report, std::FILE* out) {
  std::fprintf(
      out, "%s, %s, smoothing %s, %s\n", report.show.c_str(), report.mode.c_str(),
      report.smoothing.c_str(),
      report.threads == 0 ? "all cores" : (std::to_string(report.threads) + " threads").c_str());
  PrintTracking(report, out);
  PrintAccuracy(report, out);
  PrintTrust(report, out);
  PrintTimes(report, out);
  PrintForeign(report, out);
  std::fflush(out);
}

}  // namespace lararium::player
