#include "editor/panels/timeline/timeline_maths.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lararium::panels {

void Zoom(TimeScale& scale, double factor, float x) {
  const double held = scale.TimeAt(x);
  scale.seconds_per_px =
      std::clamp(scale.seconds_per_px * factor, TimeScale::kFinest, TimeScale::kCoarsest);
  scale.first = std::max(held - (x - scale.left) * scale.seconds_per_px, 0.0);
}

void ZoomToFit(TimeScale& scale, double seconds) {
  constexpr double kMargin = 1.04;
  scale.first = 0.0;
  scale.seconds_per_px = std::clamp(std::max(seconds, 1.0) * kMargin / std::max(scale.width, 1.0f),
                                    TimeScale::kFinest, TimeScale::kCoarsest);
}

void ScrollTo(TimeScale& scale, double seconds) {
  const double span = scale.width * scale.seconds_per_px;
  const double margin = 0.1 * span;
  if (seconds < scale.first) {
    scale.first = std::max(seconds - margin, 0.0);
  } else if (seconds > scale.first + span) {
    scale.first = std::max(seconds - span + margin, 0.0);
  }
}

RulerStep ChooseStep(double seconds_per_px, float min_px) {
  // Decimal steps below a minute, multiples of 60 above.
  constexpr RulerStep kSteps[] = {{0.01, 5}, {0.02, 4}, {0.05, 5}, {0.1, 5}, {0.2, 4}, {0.5, 5},
                                  {1, 5},    {2, 4},    {5, 5},    {10, 5},  {15, 3},  {30, 6},
                                  {60, 6},   {120, 4},  {300, 5},  {600, 5}, {900, 3}, {1800, 6},
                                  {3600, 6}, {7200, 4}, {21600, 6}};
  for (const RulerStep& step : kSteps) {
    if (step.seconds / seconds_per_px >= min_px) {
      return step;
    }
  }
  const double days = std::ceil(min_px * seconds_per_px / 86400.0);
  return {86400.0 * days, 4};
}

std::string FormatTime(double seconds, double step) {
  int decimals = 0;
  for (double unit = 1.0; decimals < 3 && step < unit * 0.999; unit /= 10.0) {
    ++decimals;
  }
  const double scale = std::pow(10.0, decimals);
  const auto units = static_cast<long long>(std::llround(std::max(seconds, 0.0) * scale));
  const auto whole = units / static_cast<long long>(scale);
  char text[64];
  const int length = whole < 3600
                         ? std::snprintf(text, sizeof(text), "%lld:%02lld", whole / 60, whole % 60)
                         : std::snprintf(text, sizeof(text), "%lld:%02lld:%02lld", whole / 3600,
                                         whole / 60 % 60, whole % 60);
  std::string out(text, static_cast<size_t>(length));
  if (decimals > 0) {
    std::snprintf(text, sizeof(text), ".%0*lld", decimals, units % static_cast<long long>(scale));
    out += text;
  }
  return out;
}

double Snap(double seconds, std::span<const double> marks, double grid, double reach) {
  double best = seconds;
  double distance = reach;
  for (const double mark : marks) {
    if (std::abs(mark - seconds) <= distance) {
      distance = std::abs(mark - seconds);
      best = mark;
    }
  }
  if (grid > 0.0) {
    const double line = std::round(seconds / grid) * grid;
    if (std::abs(line - seconds) < distance) {
      best = line;
    }
  }
  return best;
}

}  // namespace lararium::panels
