#pragma once

// Conversion between time and the horizontal position in the timeline.

#include <span>
#include <string>
#include <vector>

namespace lararium::panels {

// Times are in seconds, positions in pixels of the screen.
struct TimeScale {
  static constexpr double kFinest = 1e-3;  // Seconds per pixel.
  static constexpr double kCoarsest = 1e4;

  double first = 0.0;           // Seconds at the left edge, at least 0.
  double seconds_per_px = 0.1;  // kFinest to kCoarsest.
  float left = 0.0f;            // Left edge on the screen, pixels.
  float width = 0.0f;

  double TimeAt(float x) const { return first + (x - left) * seconds_per_px; }
  float XOf(double seconds) const {
    return left + static_cast<float>((seconds - first) / seconds_per_px);
  }
  double last() const { return first + width * seconds_per_px; }
};

// Zooms in where factor is below 1. The time at x keeps its position, unless that would show times
// below zero.
void Zoom(TimeScale& scale, double factor, float x);
// Shows [0, seconds] and a small margin.
void ZoomToFit(TimeScale& scale, double seconds);
// Scrolls by the smallest amount that makes a time visible, with a margin.
void ScrollTo(TimeScale& scale, double seconds);

// The spacing of the ruler's lines.
struct RulerStep {
  double seconds = 1.0;  // Between two numbers.
  int parts = 5;         // The number of parts between two numbers.
};
// Numbers are at least min_px apart.
RulerStep ChooseStep(double seconds_per_px, float min_px);

// "4:07", with the decimals that a spacing of step seconds needs.
std::string FormatTime(double seconds, double step);

// Snaps a time to the nearest mark or multiple of grid (0: no grid) within reach; without one,
// returns the time itself. A mark wins over a grid line at the same distance.
double Snap(double seconds, std::span<const double> marks, double grid, double reach);

}  // namespace lararium::panels
