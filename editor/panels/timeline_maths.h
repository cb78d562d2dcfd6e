#pragma once

// Time along the width of the timeline.

#include <span>
#include <string>
#include <vector>

namespace lararium::panels {

// Seconds and pixels of the screen.
struct TimeScale {
  static constexpr double kFinest = 1e-3;  // seconds a pixel
  static constexpr double kCoarsest = 1e4;

  double first = 0.0;           // seconds at the left edge, at least 0
  double seconds_per_px = 0.1;  // kFinest to kCoarsest
  float left = 0.0f;            // of the screen, pixels
  float width = 0.0f;

  double TimeAt(float x) const { return first + (x - left) * seconds_per_px; }
  float XOf(double seconds) const {
    return left + static_cast<float>((seconds - first) / seconds_per_px);
  }
  double last() const { return first + width * seconds_per_px; }
};

// Finer by a factor below 1; the time at x stays where it is, unless that is before zero.
void Zoom(TimeScale& scale, double factor, float x);
// All of [0, seconds] and a little more.
void ZoomToFit(TimeScale& scale, double seconds);
// Moves it as little as shows a time, with a margin where it has to be moved.
void ScrollTo(TimeScale& scale, double seconds);

// How far apart the lines of the ruler are.
struct RulerStep {
  double seconds = 1.0;  // between numbers
  int parts = 5;         // that lie between two of them
};
// Numbers lie at least min_px apart.
RulerStep ChooseStep(double seconds_per_px, float min_px);

// "4:07", and as many decimals as tell times apart that lie step apart.
std::string FormatTime(double seconds, double step);

// What times are drawn to: the nearest of the marks, or of the multiples of grid (0: none),
// within reach; without one, the time itself. Of two that are equally near the mark wins.
double Snap(double seconds, std::span<const double> marks, double grid, double reach);

}  // namespace lararium::panels
